#include "session/session_rig.h"

#include <gtest/gtest.h>

#include "tests/unit/session/sample_folder.h"

namespace telestrain {
namespace {

constexpr char kMirrored[] = R"(schema = "telestrain.session/1"
title = "One path"
sensor = { width_px = 2592, height_px = 1944, pixel_pitch_um = 2.2 }
lens = { magnification = 0.5, depth_of_field_mm = 3.1 }
camera = { position_mm = [0, 0, 80], axis = [0, 0, -1], image_x = [0, 1, 0], image_y = [1, 0, 0] }

[[view]]
name = "plus"
group = "B"
region_px = [1296, 972, 1296, 972]
mirrors = [{ point_mm = [2.1384, 2.8512, 40], normal = [0.70710678, 0, 0.70710678] },
           { point_mm = [13.851, 2.8512, 40], normal = [-0.70710678, 0, -0.70710678] }]

[target]
columns = 13
rows = 9
square_mm = 0.3
board = [{ group = "B", center_in_target_mm = [13.851, 0, 0] }]

[ruler]
length_mm = 3.0
)";

TEST(ReadRig, TakesAFileOrAFolderThatHasNoTables) {
  const SampleFolder folder("ReadRig");
  folder.Write("session.toml", kMirrored);
  folder.Remove("calibration.csv");
  for (const auto& path : {folder.path(), folder.path() / "session.toml"}) {
    const auto rig = ReadRig(path);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    ASSERT_EQ(rig->paths.size(), 1u);
    const OpticalPath& view = rig->paths.front();
    EXPECT_EQ(view.name, "plus");
    EXPECT_EQ(view.mirrors.size(), 2u);
    // A quarter of the sensor: from its middle to its corner, 2.2 um / 0.5 per pixel.
    EXPECT_NEAR(view.field_mm.min().norm(), 0, 1e-12);
    EXPECT_NEAR(view.field_mm.max().x(), 1296 * 0.0044, 1e-12);
    EXPECT_NEAR(view.field_mm.max().y(), 972 * 0.0044, 1e-12);
    EXPECT_NEAR(FocusPath_mm(*rig, view), 40 + 13.851 - 2.1384 + 40, 1e-6);
    EXPECT_NEAR(*rig->needed_field_mm, 12 * 0.3, 1e-12) << "more than the ruler";
    EXPECT_FALSE(rig->pipe_diameter_mm.has_value());
  }
}

TEST(ReadRig, SaysWhatToAddWhenAViewHasNoMirrors) {
  const SampleFolder folder("ReadRigVectors");
  const auto rig = ReadRig(folder.path());
  ASSERT_FALSE(rig.ok());
  EXPECT_EQ(rig.error().kind, ErrorKind::kBadInput);
  for (const char* part :
       {"session.toml: view '", "not given by mirrors", "mirrors = [{", "[camera]"})
    EXPECT_NE(rig.error().message.find(part), std::string::npos) << rig.error().message;
}

TEST(ReadRig, NamesAFileThatIsNotThere) {
  const auto rig = ReadRig("no/such/place");
  ASSERT_FALSE(rig.ok());
  EXPECT_NE(rig.error().message.find("no/such/place"), std::string::npos) << rig.error().message;
}

}  // namespace
}  // namespace telestrain
