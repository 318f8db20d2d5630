#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>

#include "base/files.h"
#include "export/small_scene.h"
#include "viz/export/ply.h"
#include "viz/export/stl.h"

namespace telestrain::viz {
namespace {

using testing::SmallScene;

// Of single precision relative to 20 mm.
constexpr double kSingle_mm = 20 * 6e-8;

std::filesystem::path Written(const std::string& name, const std::string& bytes) {
  const auto folder = std::filesystem::path(TELESTRAIN_BINARY_DIR) / "export_test";
  std::filesystem::create_directories(folder);
  EXPECT_TRUE(WriteFileAtomically(folder / name, bytes).ok());
  return folder / name;
}

TEST(Stl, TrianglesAreTheQuadsInMmAndFaceAwayFromTheAxis) {
  const Pipe pipe = *SmallScene().pipe;
  const Surface& surface = pipe.states[1].surface;
  const std::string bytes = StlBytes(pipe, 1);
  EXPECT_EQ(bytes.size(), 84 + 50 * 2 * surface.quads.size());
  EXPECT_NE(bytes.substr(0, 80).find("unit mm"), std::string::npos);
  EXPECT_NE(bytes.substr(0, 80).find("state 1"), std::string::npos);
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(Written("pipe.stl", bytes).c_str());
  reader->MergingOff();
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfPolys(), static_cast<vtkIdType>(2 * surface.quads.size()));
  for (vtkIdType i = 0; i < data->GetNumberOfPolys(); ++i) {
    Eigen::Vector3d corner[3];
    for (vtkIdType k = 0; k < 3; ++k) {
      data->GetPoint(3 * i + k, corner[k].data());
      const auto& quad = surface.quads[static_cast<std::size_t>(i / 2)];
      double nearest_mm = 1;
      for (const int point : quad)
        nearest_mm = std::min(
            nearest_mm,
            (surface.points_in_array_mm[static_cast<std::size_t>(point)] - corner[k]).norm());
      EXPECT_LT(nearest_mm, 2 * kSingle_mm);
    }
    EXPECT_GT((corner[1] - corner[0]).cross(corner[2] - corner[0]).z(), 0);
  }
}

TEST(Stl, HeaderBearsStrangeNamesOfSteps) {
  Pipe pipe = *SmallScene().pipe;
  pipe.states[1].step = std::string(200, 'x') + "\u00b5\n";
  const std::string bytes = StlBytes(pipe, 1);
  EXPECT_EQ(bytes.size(), 84 + 50 * 2 * pipe.states[1].surface.quads.size());
  EXPECT_FALSE(bytes.starts_with("solid"));
}

// The columns of a PLY file whose vertices are doubles and end with one int.
std::map<std::string, std::vector<double>> ColumnsOf(const std::string& bytes) {
  const std::string end = "end_header\n";
  std::istringstream header(bytes.substr(0, bytes.find(end)));
  std::vector<std::string> names;
  for (std::string line, word, type, name; std::getline(header, line);) {
    std::istringstream words(line);
    if (words >> word >> type >> name; word != "property" || type != "double") continue;
    names.push_back(name);
  }
  const std::string body = bytes.substr(bytes.find(end) + end.size());
  const std::size_t row = 8 * names.size() + 4;
  EXPECT_EQ(body.size() % row, 0U);
  std::map<std::string, std::vector<double>> columns;
  for (std::size_t at = 0; at + row <= body.size(); at += row)
    for (std::size_t i = 0; i < names.size(); ++i) {
      double number = 0;
      std::memcpy(&number, body.data() + at + 8 * i, 8);
      columns[names[i]].push_back(number);
    }
  return columns;
}

TEST(Ply, HoldsEveryMeasuredNumberExactlyUnderANameWithItsUnit) {
  const Pipe pipe = *SmallScene().pipe;
  const Surface& surface = pipe.states[1].surface;
  const std::string bytes = PlyBytes(pipe, 1);
  EXPECT_NE(bytes.find("comment x y z in mm"), std::string::npos);
  auto columns = ColumnsOf(bytes);
  EXPECT_EQ(columns.size(), 9U);
  EXPECT_EQ(columns["sigma_um"], surface.sigma_um);
  EXPECT_EQ(columns["axial_microstrain"], surface.values[0].values);
  EXPECT_TRUE(std::isnan(columns["hoop_microstrain"][0]));
  for (std::size_t i = 0; i < surface.points_in_array_mm.size(); ++i) {
    EXPECT_EQ(columns["x"][i], surface.points_in_array_mm[i].x());
    EXPECT_EQ(columns["displacement_z_mm"][i], surface.displacement_mm[i].z());
  }
}

TEST(Ply, OpensInVtk) {
  const Pipe pipe = *SmallScene().pipe;
  const Surface& surface = pipe.states[2].surface;
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(Written("pipe.ply", PlyBytes(pipe, 2)).c_str());
  reader->Update();
  ASSERT_EQ(static_cast<std::size_t>(reader->GetOutput()->GetNumberOfPoints()),
            surface.points_in_array_mm.size());
  for (std::size_t i = 0; i < surface.points_in_array_mm.size(); ++i) {
    Eigen::Vector3d point;
    reader->GetOutput()->GetPoint(static_cast<vtkIdType>(i), point.data());
    EXPECT_LT((point - surface.points_in_array_mm[i]).norm(), 2 * kSingle_mm);
  }
}

TEST(Ply, LeavesOutWhatWasNotMeasured) {
  Pipe pipe = *SmallScene().pipe;
  pipe.states[1].surface.sigma_um.clear();
  pipe.states[1].surface.values.pop_back();
  pipe.states[1].surface.displacement_mm.clear();
  const auto columns = ColumnsOf(PlyBytes(pipe, 1));
  EXPECT_EQ(columns.size(), 5U);
  EXPECT_FALSE(columns.contains("sigma_um"));
}

}  // namespace
}  // namespace telestrain::viz
