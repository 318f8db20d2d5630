#include "viz/export/glb.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/files.h"
#include "export/glb_file.h"
#include "export/small_scene.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

using testing::GlbContent;
using testing::OpenGlb;
using testing::SmallScene;

constexpr char kSurface[] = "state 1 (cycle 1, step 1): surface A";

std::string BytesOf(const Scene& scene, const std::string& quantity = "") {
  const auto shown = ChooseValues(scene, "largest", quantity);
  EXPECT_TRUE(shown.ok());
  return GlbBytes(PartsOf(scene).parts, AxesOf(scene), *shown);
}

const nlohmann::json& PrimitiveOf(const GlbContent& content, const std::string& part) {
  const nlohmann::json* node = content.Node(part);
  EXPECT_NE(node, nullptr) << part;
  return content.json["meshes"][(*node)["mesh"].get<std::size_t>()]["primitives"][0];
}

TEST(Glb, EveryViewIsAlignedAndInTheBufferAndEveryRangeIsThatOfItsNumbers) {
  const GlbContent content = OpenGlb(BytesOf(SmallScene()));
  EXPECT_EQ(content.json["buffers"][0]["byteLength"], content.buffer.size());
  for (const auto& view : content.json["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
    EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(),
              content.buffer.size());
  }
  for (const auto& mesh : content.json["meshes"])
    for (const auto& primitive : mesh["primitives"]) {
      const auto position = primitive["attributes"]["POSITION"].get<std::size_t>();
      const auto numbers = content.Numbers<float>(position);
      const auto& accessor = content.json["accessors"][position];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        float low = numbers[axis], high = numbers[axis];
        for (std::size_t i = axis; i < numbers.size(); i += 3) {
          low = std::min(low, numbers[i]);
          high = std::max(high, numbers[i]);
        }
        EXPECT_EQ(accessor["min"][axis].get<double>(), double(low));
        EXPECT_EQ(accessor["max"][axis].get<double>(), double(high));
      }
      const auto indices = content.Numbers<std::uint32_t>(primitive["indices"].get<std::size_t>());
      EXPECT_EQ(indices.size() % (primitive["mode"] == 1 ? 2 : 3), 0U);
      EXPECT_LT(*std::max_element(indices.begin(), indices.end()), numbers.size() / 3);
    }
}

TEST(Glb, HasANodePerPartOfTheShownStateWithItsFacts) {
  const Scene scene = SmallScene();
  const GlbContent content = OpenGlb(BytesOf(scene));
  std::size_t nodes = 1;  // the root
  for (const Part& part : PartsOf(scene).parts) {
    const nlohmann::json* node = content.Node(part.name);
    if (part.state != kEveryState && part.state != 1) {
      EXPECT_EQ(node, nullptr) << part.name;
      continue;
    }
    ++nodes;
    ASSERT_NE(node, nullptr) << part.name;
    EXPECT_EQ((*node)["extras"]["layer"], NameOf(part.layer));
    ASSERT_EQ((*node)["extras"]["facts"].size(), part.facts.size());
    for (std::size_t i = 0; i < part.facts.size(); ++i)
      EXPECT_EQ((*node)["extras"]["facts"][i]["value"], part.facts[i].value);
  }
  EXPECT_EQ(content.json["nodes"].size(), nodes);
  const auto& colors = content.json["scenes"][0]["extras"]["colors"];
  EXPECT_EQ(colors["quantity"], "axial_microstrain");
  EXPECT_EQ(colors["unit"], "\u00b5\u03b5");
  EXPECT_EQ(colors["low"], ValueScale(*scene.pipe, "axial_microstrain").low);
}

TEST(Glb, SurfaceCarriesTheLinearColoursAndTheNumbersOfItsQuantity) {
  const Scene scene = SmallScene();
  const GlbContent content = OpenGlb(BytesOf(scene));
  const auto& attributes = PrimitiveOf(content, kSurface)["attributes"];
  const auto colors = content.Numbers<float>(attributes["COLOR_0"].get<std::size_t>());
  const auto numbers = content.Numbers<float>(attributes["_AXIAL_MICROSTRAIN"].get<std::size_t>());
  const Surface& surface = scene.pipe->Largest().surface;
  ASSERT_EQ(numbers.size(), testing::kColumns * testing::kRows);
  ASSERT_EQ(colors.size(), 3 * numbers.size());
  const ColorMap map = ValueColorMap(ValueScale(*scene.pipe, "axial_microstrain"));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(numbers[i], static_cast<float>(surface.values[0].values[i]));
    const Rgb color = map.At(surface.values[0].values[i]);
    const double srgb[] = {color.r, color.g, color.b};
    for (std::size_t k = 0; k < 3; ++k) {
      const double linear = colors[3 * i + k];  // back as IEC 61966-2-1 has it
      const double back =
          linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
      // The standard's two branches meet only to 1e-7 or so; a byte is 4e-3.
      EXPECT_NEAR(back, srgb[k], 1e-5);
    }
  }
}

TEST(Glb, LeavesOutNumbersThatAPointLacks) {
  const GlbContent content = OpenGlb(BytesOf(SmallScene(), "hoop_microstrain"));
  EXPECT_FALSE(PrimitiveOf(content, kSurface)["attributes"].contains("_HOOP_MICROSTRAIN"));
  const std::string b = "state 1 (cycle 1, step 1): surface B";
  EXPECT_TRUE(PrimitiveOf(content, b)["attributes"].contains("_HOOP_MICROSTRAIN"));
}

TEST(Glb, MaterialsHaveTheOpacityOfThePartAndLinesAreOpaque) {
  const Scene scene = SmallScene();
  const GlbContent content = OpenGlb(BytesOf(scene));
  const auto parts = PartsOf(scene).parts;
  const auto box = std::find_if(parts.begin(), parts.end(), [](const Part& part) {
    return part.name == "view A1: depth of field";
  });
  ASSERT_NE(box, parts.end());
  const auto mesh = (*content.Node(box->name))["mesh"].get<std::size_t>();
  const auto& primitives = content.json["meshes"][mesh]["primitives"];
  ASSERT_EQ(primitives.size(), 2U);
  const auto material = [&](std::size_t i) {
    return content.json["materials"][primitives[i]["material"].get<std::size_t>()];
  };
  EXPECT_EQ(material(0)["pbrMetallicRoughness"]["baseColorFactor"][3], box->opacity);
  EXPECT_EQ(material(0)["alphaMode"], "BLEND");
  EXPECT_FALSE(material(0).contains("extensions"));  // lit
  EXPECT_EQ(primitives[1]["mode"], 1);
  EXPECT_EQ(material(1)["pbrMetallicRoughness"]["baseColorFactor"][3], 1.0);
  EXPECT_TRUE(material(1)["extensions"].contains("KHR_materials_unlit"));
}

struct ReadCounts {
  std::size_t points = 0, polygons = 0, lines = 0;
  double lowest_y_m = 1, highest_y_m = -1, lowest_x_m = 1, highest_x_m = -1;
};

ReadCounts CountsOf(vtkMultiBlockDataSet* blocks) {
  ReadCounts counts;
  const auto iterator = vtk::TakeSmartPointer(blocks->NewTreeIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem()) {
    auto* data = vtkPolyData::SafeDownCast(iterator->GetCurrentDataObject());
    if (data == nullptr) continue;
    counts.points += static_cast<std::size_t>(data->GetNumberOfPoints());
    counts.polygons += static_cast<std::size_t>(data->GetNumberOfPolys());
    counts.lines += static_cast<std::size_t>(data->GetNumberOfLines());
    const double* bounds = data->GetBounds();
    counts.lowest_x_m = std::min(counts.lowest_x_m, bounds[0]);
    counts.highest_x_m = std::max(counts.highest_x_m, bounds[1]);
    counts.lowest_y_m = std::min(counts.lowest_y_m, bounds[2]);
    counts.highest_y_m = std::max(counts.highest_y_m, bounds[3]);
  }
  return counts;
}

TEST(Glb, OpensInVtkWithTheCamerasUpInMetres) {
  const Scene scene = SmallScene();
  const auto folder = std::filesystem::path(TELESTRAIN_BINARY_DIR) / "export_test";
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(WriteFileAtomically(folder / "scene.glb", BytesOf(scene)).ok());
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName((folder / "scene.glb").c_str());
  reader->Update();
  const ReadCounts counts = CountsOf(reader->GetOutput());
  std::size_t triangles = 0, lines = 0;
  Eigen::AlignedBox3d box_mm;
  for (const Part& part : PartsOf(scene).parts) {
    if (part.state != kEveryState && part.state != 1) continue;
    for (const auto& face : part.mesh.faces) triangles += face.size() - 2;
    lines += part.mesh.lines.size();
    for (const Eigen::Vector3d& point : part.mesh.points_in_array_mm) box_mm.extend(point);
  }
  EXPECT_EQ(counts.polygons, triangles);
  EXPECT_EQ(counts.lines, lines);
  // z points to the cameras here, which is y in glTF. Single precision: 2^-24 of 50 mm.
  constexpr double kTolerance_m = 3e-9;
  EXPECT_NEAR(counts.lowest_x_m, 1e-3 * box_mm.min().x(), kTolerance_m);
  EXPECT_NEAR(counts.highest_x_m, 1e-3 * box_mm.max().x(), kTolerance_m);
  EXPECT_NEAR(counts.lowest_y_m, 1e-3 * box_mm.min().z(), kTolerance_m);
  EXPECT_NEAR(counts.highest_y_m, 1e-3 * box_mm.max().z(), kTolerance_m);
}

TEST(Glb, SameSceneSameBytesAndAnEmptyOneIsValid) {
  EXPECT_EQ(BytesOf(SmallScene()), BytesOf(SmallScene()));
  const GlbContent empty = OpenGlb(GlbBytes({}, AxesOf(Scene{}), std::nullopt));
  EXPECT_FALSE(empty.json.contains("meshes"));
  EXPECT_TRUE(empty.buffer.empty());
}

}  // namespace
}  // namespace telestrain::viz
