#include "viz/export/paraview.h"

#include <gtest/gtest.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLMultiBlockDataReader.h>

#include <filesystem>

#include "base/files.h"
#include "export/small_scene.h"
#include "viz/export/shown_values.h"

namespace telestrain::viz {
namespace {

using testing::SmallScene;

// The blocks of the scene, written and read again by VTK.
vtkSmartPointer<vtkMultiBlockDataSet> ReadBack(const Scene& scene) {
  const auto folder = std::filesystem::path(TELESTRAIN_BINARY_DIR) / "export_test" /
                      ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::remove_all(folder);
  const auto files = ParaViewFiles(scene, PartsOf(scene).parts);
  EXPECT_TRUE(files.ok());
  for (const auto& [name, bytes] : *files) {
    std::filesystem::create_directories((folder / name).parent_path());
    EXPECT_TRUE(WriteFileAtomically(folder / name, bytes).ok());
  }
  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName((folder / "scene.vtm").c_str());
  reader->Update();
  return vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
}

vtkDataObject* Find(vtkMultiBlockDataSet* blocks, const std::string& name) {
  for (unsigned i = 0; i < blocks->GetNumberOfBlocks(); ++i) {
    const char* found = blocks->GetMetaData(i)->Get(vtkCompositeDataSet::NAME());
    if (found != nullptr && name == found) return blocks->GetBlock(i);
  }
  return nullptr;
}

TEST(ParaViewFiles, HaveABlockPerLayerAndPartWithItsPoints) {
  const Scene scene = SmallScene();
  const auto blocks = ReadBack(scene);
  ASSERT_NE(blocks, nullptr);
  for (const Part& part : PartsOf(scene).parts) {
    if (part.layer == Layer::kSurface) continue;
    auto* layer = vtkMultiBlockDataSet::SafeDownCast(Find(blocks, NameOf(part.layer)));
    ASSERT_NE(layer, nullptr) << NameOf(part.layer);
    auto* data = vtkPolyData::SafeDownCast(Find(layer, part.name));
    ASSERT_NE(data, nullptr) << part.name;
    ASSERT_EQ(static_cast<std::size_t>(data->GetNumberOfPoints()),
              part.mesh.points_in_array_mm.size());
    EXPECT_EQ(static_cast<std::size_t>(data->GetNumberOfPolys()), part.mesh.faces.size());
    EXPECT_EQ(static_cast<std::size_t>(data->GetNumberOfLines()), part.mesh.lines.size());
    Eigen::Vector3d last;
    data->GetPoint(data->GetNumberOfPoints() - 1, last.data());
    EXPECT_EQ(last, part.mesh.points_in_array_mm.back()) << part.name;
    if (part.facts.empty()) continue;
    auto* facts = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("facts"));
    ASSERT_NE(facts, nullptr) << part.name;
    EXPECT_EQ(facts->GetValue(0), part.facts[0].name + ": " + part.facts[0].value);
  }
}

TEST(ParaViewFiles, HaveEveryStateWithEveryNumberUnderANameWithItsUnit) {
  const Scene scene = SmallScene();
  const auto blocks = ReadBack(scene);
  auto* layer = vtkMultiBlockDataSet::SafeDownCast(Find(blocks, "surface"));
  ASSERT_NE(layer, nullptr);
  ASSERT_EQ(layer->GetNumberOfBlocks(), 3U);
  for (std::size_t state = 0; state < 3; ++state) {
    auto* data = vtkPolyData::SafeDownCast(Find(layer, StateText(*scene.pipe, state)));
    ASSERT_NE(data, nullptr) << state;
    const Surface& surface = scene.pipe->states[state].surface;
    vtkPointData* arrays = data->GetPointData();
    for (const char* name :
         {"displacement_mm", "sigma_um", "axial_microstrain", "hoop_microstrain", "group"})
      ASSERT_NE(arrays->GetArray(name), nullptr) << name;
    for (std::size_t i = 0; i < surface.points_in_array_mm.size(); ++i) {
      const auto id = static_cast<vtkIdType>(i);
      EXPECT_EQ(arrays->GetArray("axial_microstrain")->GetComponent(id, 0),
                surface.values[0].values[i]);
      EXPECT_EQ(arrays->GetArray("displacement_mm")->GetComponent(id, 2),
                surface.displacement_mm[i].z());
      EXPECT_EQ(arrays->GetArray("group")->GetComponent(id, 0), surface.group[i]);
    }
  }
}

TEST(ParaViewFiles, BearNamesThatXmlDoesNot) {
  Scene scene = SmallScene();
  scene.views[0].name = "a \"view\" <1> & more\n";
  const auto blocks = ReadBack(scene);
  ASSERT_NE(blocks, nullptr);
  auto* views = vtkMultiBlockDataSet::SafeDownCast(Find(blocks, "views"));
  ASSERT_NE(views, nullptr);
  EXPECT_NE(Find(views, "view a \"view\" <1> & more : depth of field"), nullptr);
}

TEST(ParaViewFiles, SameSceneSameBytes) {
  const Scene scene = SmallScene();
  const auto parts = PartsOf(scene).parts;
  EXPECT_EQ(*ParaViewFiles(scene, parts), *ParaViewFiles(scene, parts));
}

}  // namespace
}  // namespace telestrain::viz
