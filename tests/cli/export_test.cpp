#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <opencv2/core.hpp>
#include <sstream>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

// The point that is projected, mm of the array's frame.
constexpr char kPoint[] = "[-12.5, 0.4, 0.7]";

class Export : public SessionCopy {
 protected:
  fs::path out() const { return scratch() / "interchange"; }
  ProgramRun RunExport(const fs::path& folder) const {
    return RunTelestrain({"export", results().string(), "--out", folder.string()});
  }
};

// The equations of opencv.yaml's comments.
cv::Vec2d ProjectAsDocumented(const cv::FileNode& view, const cv::Vec3d& point) {
  cv::Mat scale, center, rotation, offset, k;
  view["K_px_per_mm"] >> scale;
  view["center_px"] >> center;
  view["R"] >> rotation;
  view["t_mm"] >> offset;
  view["distortion"] >> k;
  const cv::Mat turned = rotation * cv::Mat(point);
  const double z =
      double(view["depth_sense"]) * turned.at<double>(2) + double(view["depth_offset_mm"]);
  const double larger = 1 + double(view["telecentricity_per_mm"]) * z;
  const double x = (turned.at<double>(0) + offset.at<double>(0)) / larger;
  const double y = (turned.at<double>(1) + offset.at<double>(1)) / larger;
  const auto c = [&](int i) { return k.at<double>(i); };
  const double r2 = x * x + y * y;
  const double radial = 1 + c(0) * r2 + c(1) * r2 * r2 + c(4) * r2 * r2 * r2;
  const double px = x * radial + 2 * c(2) * x * y + c(3) * (r2 + 2 * x * x);
  const double py = y * radial + c(2) * (r2 + 2 * y * y) + 2 * c(3) * x * y;
  return {scale.at<double>(0, 0) * px + center.at<double>(0),
          scale.at<double>(1, 1) * py + center.at<double>(1)};
}

TEST_F(Export, OpensInOpenCvAndInMrcalAndBothProjectAlike) {
  TakeRun({"detect", "calibrate"});
  const ProgramRun run = RunExport(out());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("export     A1.cameramodel ")) << run.out;
  cv::FileStorage storage((out() / "opencv.yaml").string(), cv::FileStorage::READ);
  ASSERT_TRUE(storage.isOpened());
  EXPECT_EQ(int(storage["image_width"]), 648);
  ASSERT_EQ(storage["views"].size(), 4U);
  if (std::system("/usr/bin/python3 -c 'import mrcal' >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "python3-mrcal is not installed";
  for (const cv::FileNode& view : storage["views"]) {
    const fs::path model = out() / (std::string(view["name"]) + ".cameramodel");
    const ProgramRun mrcal =
        RunProgram({"/usr/bin/python3", "-c",
                    "import mrcal, numpy, sys\n"
                    "m = mrcal.cameramodel(sys.argv[1])\n"
                    "assert list(m.imagersize()) == [648, 486]\n"
                    "assert len(m.valid_intrinsics_region()) == 5\n"
                    "p = mrcal.transform_point_rt(m.extrinsics_rt_fromref(), numpy.array(" +
                        std::string(kPoint) +
                        "))\nprint('%.17g %.17g' % tuple(mrcal.project(p, *m.intrinsics())))",
                    model.string()});
    ASSERT_EQ(mrcal.exit_code, 0) << mrcal.err;
    std::istringstream text(mrcal.out);
    cv::Vec2d theirs;
    text >> theirs[0] >> theirs[1];
    const cv::Vec2d ours = ProjectAsDocumented(view, {-12.5, 0.4, 0.7});
    // The finite distance: 3000 px from the axis at 20 mm of depth, over 1e12 mm; rounding.
    EXPECT_LT(cv::norm(ours - theirs), 1e-7) << model;
  }
}

TEST_F(Export, CornersAreThoseThatTheCalibrationUsed) {
  TakeRun({"detect", "calibrate"});
  ASSERT_EQ(RunExport(out()).exit_code, 0);
  std::istringstream used(ReadAll(out() / "corners.vnl"));
  const std::string all = ReadAll(results() / "corners.vnl");
  long corners = 0;
  for (std::string line; std::getline(used, line);) {
    if (line.starts_with("#") || line.ends_with(" - - -")) continue;
    ++corners;
    ASSERT_NE(all.find(line + "\n"), std::string::npos) << line;
  }
  const std::string table = ReadAll(results() / "residuals.csv");
  EXPECT_EQ(corners, std::count(table.begin(), table.end(), '\n') - 1);
}

TEST_F(Export, WritesTheSceneForProgramsThatShowAndMeasureIt) {
  TakeRun({"detect", "calibrate", "measure"});
  const std::vector<std::string> words = {
      "export", results().string(), "--out", out().string(), "--format", "glb,paraview,stl,ply"};
  const ProgramRun run = RunTelestrain(words);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("export     scene.glb pipe.stl pipe.ply scene.vtm (")) << run.out;
  // The state with the largest strain of three: 0 is the reference, 2 is unloaded again.
  EXPECT_NE(ReadAll(out() / "pipe.ply").find("state 1, "), std::string::npos);
  const auto first = BytesBelow(out());
  const std::string index = ReadAll(out() / "scene.vtm");
  for (const auto& [name, bytes] : first) {
    if (!name.ends_with(".vtp")) continue;
    EXPECT_NE(index.find("\"" + name + "\""), std::string::npos) << name;
  }
  ASSERT_EQ(RunTelestrain(words).exit_code, 0);
  EXPECT_EQ(BytesBelow(out()), first);
}

TEST_F(Export, ParaViewPiecesOfAnEarlierExportGoAndOtherFilesStay) {
  TakeRun({"detect", "calibrate"});
  const std::vector<std::string> words = {"export",       results().string(), "--out",
                                          out().string(), "--format",         "paraview"};
  ASSERT_EQ(RunTelestrain(words).exit_code, 0);
  const auto first = BytesBelow(out());
  auto wanted = first;
  const std::string own = "scene/surface_007.vtp", more = "scene/boards_1000.vtp";
  ASSERT_FALSE(first.contains(own) || first.contains(more));
  for (const std::string& name : {own, more}) std::ofstream(out() / name) << "old";
  for (const std::string name : {"scene/mine_000.vtp", "scene/surface_07.vtp", "scene/surface.vtp",
                                 "scene/surface_007.vtu", "surface_007.vtp"})
    std::ofstream(out() / name) << (wanted[name] = "mine");
  ASSERT_EQ(RunTelestrain(words).exit_code, 0);
  EXPECT_EQ(BytesBelow(out()), wanted);
}

TEST_F(Export, UsageErrorsNameWhatThereIsAndWriteNothing) {
  TakeRun({"detect", "calibrate", "measure"});
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"export", results().string(), "--out", out().string()});
    return RunTelestrain(more);
  };
  for (const auto& [more, named] :
       {std::pair<std::vector<std::string>, std::string>{{"--format", "obj"}, "paraview"},
        {{"--format", "glb", "--state", "3"}, "0 to 2"},
        {{"--format", "glb", "--quantity", "axial"}, "axial_microstrain"},
        {{"--format", "stl", "--quantity", "axial_microstrain"}, "glb only"},
        {{"--state", "1"}, "--format glb, stl and ply"}}) {
    const ProgramRun bad = run(more);
    EXPECT_EQ(bad.exit_code, 2) << bad.err;
    EXPECT_NE(bad.err.find(named), std::string::npos) << bad.err;
    EXPECT_FALSE(fs::exists(out()));
  }
}

TEST_F(Export, BadInputSaysWhatToDo) {
  const ProgramRun none = RunExport(out());
  EXPECT_EQ(none.exit_code, 3) << none.err;
  EXPECT_FALSE(fs::exists(out()));
  TakeRun({"detect", "calibrate"});
  const ProgramRun unmeasured =
      RunTelestrain({"export", results().string(), "--out", out().string(), "--format", "glb,stl"});
  EXPECT_EQ(unmeasured.exit_code, 3) << unmeasured.err;
  EXPECT_NE(unmeasured.err.find("telestrain measure"), std::string::npos) << unmeasured.err;
  EXPECT_FALSE(fs::exists(out()));
  MustRun({"detect"});
  const ProgramRun early = RunExport(out());
  EXPECT_EQ(early.exit_code, 3) << early.err;
  EXPECT_NE(early.err.find("telestrain calibrate"), std::string::npos) << early.err;
  const std::string corners = ReadAll(results() / "corners.vnl");
  const ProgramRun same = RunExport(results());
  EXPECT_EQ(same.exit_code, 3) << same.err;
  EXPECT_NE(same.err.find("another folder"), std::string::npos) << same.err;
  EXPECT_EQ(ReadAll(results() / "corners.vnl"), corners);
}

}  // namespace
}  // namespace telestrain::testing_support
