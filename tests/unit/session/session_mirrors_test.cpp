#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "session/session.h"
#include "session/session_record.h"
#include "tests/unit/session/sample_folder.h"

namespace telestrain {
namespace {

// Two views of the array of measurement-model.md section 13, group +1, given by three mirrors each.
constexpr char kMirrors[] = R"(schema = "telestrain.session/1"
title = "Mirrors"
sensor = { width_px = 2592, height_px = 1944, pixel_pitch_um = 2.2 }
lens = { magnification = 0.5, depth_of_field_mm = 3.1 }

[camera]
position_mm = [0, 0, 100]
axis = [0, 0, -1]
image_x = [0, 1, 0]
image_y = [1, 0, 0]

[[view]]
name = "plus"
group = "B"
region_px = [1296, 972, 1296, 972]
mirrors = [
  { point_mm = [2.1384, 2.8512, 40], normal = [0.7071, 0, 0.7071] },
  { point_mm = [13.851, 2.8512, 40], normal = [-0.7071, 0.7071, 0] },
  { point_mm = [13.851, 23.094, 40], normal = [0, -0.8660254, -0.5] },
]

[[view]]
name = "minus"
group = "B"
region_px = [0, 972, 1296, 972]
mirrors = [
  { point_mm = [2.1384, -2.8512, 40], normal = [0.7071, 0, 0.7071] },
  { point_mm = [13.851, -2.8512, 40], normal = [-0.7071, -0.7071, 0] },
  { point_mm = [13.851, -23.094, 40], normal = [0, 0.8660254, -0.5] },
]

[target]
columns = 13
rows = 9
square_mm = 0.3
board = [{ group = "B", center_in_target_mm = [0, 0, 0] }]
)";

// What the three mirrors of "plus" make, to be put behind its name.
constexpr char kVectors[] = R"(
image_x_in_array = [1, 0, 0]
image_y_in_array = [0.0, 0.866, -0.5]
axis_in_array = [0.0, -0.5, -0.866]
center_in_array_mm = [13.851, 0.0, 0.0]
)";

class MirrorFolder : public SampleFolder {
 public:
  explicit MirrorFolder(const std::string& name) : SampleFolder("mirrors_" + name) {
    Write("session.toml", kMirrors);
    Remove("ruler.csv");
    Remove("pipe.csv");
  }
};

Session ReadOrFail(const SampleFolder& sample) {
  const auto session = ReadSession(sample.path());
  if (!session) throw std::runtime_error(session.error().message);
  return *session;
}

TEST(MirrorViewTest, ThreeMirrorsGiveTheDesignedView) {
  const Session session = ReadOrFail(MirrorFolder("designed"));
  ASSERT_EQ(session.views.size(), 2u);
  for (const int sy : {1, -1}) {
    const NominalView& view = session.views[sy == 1 ? 0 : 1];
    // The mirrors' points are rounded to 0.5 um and their normals to 1e-7.
    EXPECT_LT((view.axis_in_array - Eigen::Vector3d(0, -0.5 * sy, -std::sqrt(0.75))).norm(), 1e-6);
    EXPECT_LT((view.center_in_array_mm - Eigen::Vector3d(13.851, 0, 0)).norm(), 2e-3)
        << view.center_in_array_mm.transpose();
    EXPECT_NEAR(view.center_in_array_mm.z(), 0, 1e-12);
    EXPECT_NEAR(std::abs(view.image_x_in_array.x()), 1, 1e-6);
    // Three reflections: the image is mirrored, so the cross product is against the axis.
    const Eigen::Vector3d normal = view.image_x_in_array.cross(view.image_y_in_array);
    const Eigen::Vector3d physical_normal = session.camera->image_x.cross(session.camera->image_y);
    EXPECT_NEAR(normal.dot(view.axis_in_array), -physical_normal.dot(session.camera->axis), 1e-9);
  }
}

TEST(MirrorViewTest, RayParallelToThePlaneTakesThePointNearestToTheOrigin) {
  const MirrorFolder sample("flat");
  const std::string text = sample.Read("session.toml");
  const auto second = text.rfind("  { point_mm = [13.851, 2.8512"),
             end = text.find("]\n\n[[view]]\nname = \"minus");
  sample.Write("session.toml", text.substr(0, second) + text.substr(end));
  const Session session = ReadOrFail(sample);
  const NominalView& view = session.views[0];
  EXPECT_NEAR(view.axis_in_array.z(), 0, 1e-9);
  EXPECT_NEAR(view.center_in_array_mm.dot(view.axis_in_array), 0, 1e-12);
}

TEST(MirrorViewTest, VectorsThatAgreeAreKept) {
  const MirrorFolder sample("agree");
  sample.Replace("session.toml", "name = \"plus\"", std::string("name = \"plus\"") + kVectors);
  const Session session = ReadOrFail(sample);
  EXPECT_EQ(session.views[0].image_x_in_array, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(session.views[0].mirrors.size(), 3u);
}

TEST(MirrorViewTest, AnEmptyListOfMirrorsMeansVectors) {
  const SampleFolder sample("empty_mirrors");
  sample.Replace("session.toml", "name = \"A1\"", "name = \"A1\"\nmirrors = []");
  EXPECT_TRUE(ReadOrFail(sample).views[0].mirrors.empty());
}

TEST(MirrorViewTest, RoundTripIsExact) {
  const MirrorFolder sample("round_trip");
  const Session first = ReadOrFail(sample);
  ASSERT_TRUE(WriteSession(first, sample.path()).ok());
  const Session second = ReadOrFail(sample);
  EXPECT_EQ(first.camera->image_x, second.camera->image_x);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(first.views[i].image_x_in_array, second.views[i].image_x_in_array);
    EXPECT_EQ(first.views[i].image_y_in_array, second.views[i].image_y_in_array);
    EXPECT_EQ(first.views[i].axis_in_array, second.views[i].axis_in_array);
    EXPECT_EQ(first.views[i].center_in_array_mm, second.views[i].center_in_array_mm);
    ASSERT_EQ(second.views[i].mirrors.size(), 3u);
    for (std::size_t m = 0; m < 3; ++m) {
      EXPECT_EQ(first.views[i].mirrors[m].point_mm, second.views[i].mirrors[m].point_mm);
      EXPECT_EQ(first.views[i].mirrors[m].normal, second.views[i].mirrors[m].normal);
    }
  }
}

TEST(MirrorViewTest, ARecordKeepsCameraAndMirrors) {
  const Session session = ReadOrFail(MirrorFolder("record"));
  const nlohmann::ordered_json record = SessionRecord(session);
  const Session again = SessionOfRecord(record);
  ASSERT_TRUE(again.camera.has_value());
  EXPECT_EQ(SessionRecord(again).at("camera"), record.at("camera"));
  EXPECT_EQ(again.camera->position_mm, Eigen::Vector3d(0, 0, 100));
  EXPECT_EQ(again.camera->axis, session.camera->axis);
  EXPECT_EQ(again.camera->image_x, session.camera->image_x);
  EXPECT_EQ(again.camera->image_y, session.camera->image_y);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(again.views[i].mirrors.size(), 3u);
    for (std::size_t m = 0; m < 3; ++m) {
      EXPECT_EQ(again.views[i].mirrors[m].point_mm, session.views[i].mirrors[m].point_mm);
      EXPECT_EQ(again.views[i].mirrors[m].normal, session.views[i].mirrors[m].normal);
    }
  }
}

TEST(MirrorViewTest, ARecordWithoutMirrorsReads) {
  const Session session = ReadOrFail(SampleFolder("record_without_mirrors"));
  const nlohmann::ordered_json record = SessionRecord(session);
  EXPECT_FALSE(record.contains("camera"));
  EXPECT_FALSE(record.at("views").at(0).contains("mirrors"));
  const Session again = SessionOfRecord(record);
  EXPECT_FALSE(again.camera.has_value());
  EXPECT_TRUE(again.views[0].mirrors.empty());
}

struct Disagreement {
  std::string name;
  std::string from, to;  // replaced in the vectors
  std::vector<std::string> says;
};

void PrintTo(const Disagreement& disagreement, std::ostream* out) { *out << disagreement.name; }

class MirrorDisagreementTest : public testing::TestWithParam<Disagreement> {};

TEST_P(MirrorDisagreementTest, NamesBoth) {
  const MirrorFolder sample(GetParam().name);
  sample.Replace("session.toml", "name = \"plus\"", std::string("name = \"plus\"") + kVectors);
  sample.Replace("session.toml", GetParam().from, GetParam().to);
  const auto session = ReadSession(sample.path());
  ASSERT_FALSE(session.ok());
  const std::string& message = session.error().message;
  const std::string place =
      "session.toml:" + std::to_string(sample.LineOf("session.toml", GetParam().to)) + ": ";
  for (const std::string& words : GetParam().says)
    EXPECT_NE(message.find(words), std::string::npos) << message << "\nlacks: " << words;
  EXPECT_NE(message.find(place), std::string::npos) << message << "\nlacks: " << place;
}

INSTANTIATE_TEST_SUITE_P(
    MirrorViewTest, MirrorDisagreementTest,
    testing::Values(
        Disagreement{"direction",
                     "axis_in_array = [0.0, -0.5, -0.866]",
                     "axis_in_array = [0.0, -0.515, -0.857]",
                     {"view[1].axis_in_array and the mirrors of view 'plus' disagree by",
                      "limit 0.5 deg", "correct one of them"}},
        Disagreement{"sign",
                     "image_y_in_array = [0.0, 0.866, -0.5]",
                     "image_y_in_array = [0.0, -0.866, 0.5]",
                     {"image_y_in_array and the mirrors of view 'plus'"}},
        Disagreement{"center",
                     "center_in_array_mm = [13.851, 0.0, 0.0]",
                     "center_in_array_mm = [13.951, 0.0, 0.0]",
                     {"center_in_array_mm and the mirrors of view 'plus'",
                      "across the axis, limit 0.05 mm"}}),
    [](const auto& test) { return test.param.name; });

TEST(MirrorViewTest, CentreMayMoveAlongTheAxis) {
  const MirrorFolder sample("along");
  sample.Replace("session.toml", "name = \"plus\"", std::string("name = \"plus\"") + kVectors);
  sample.Replace("session.toml", "center_in_array_mm = [13.851, 0.0, 0.0]",
                 "center_in_array_mm = [13.851, 0.5, 0.866]");
  EXPECT_TRUE(ReadSession(sample.path()).ok());
}

TEST(MirrorViewTest, CameraAxesAreChecked) {
  const MirrorFolder sample("camera_axes");
  sample.Replace("session.toml", "image_x = [0, 1, 0]", "image_x = [0.0523, 0.9986, 0]");
  const auto session = ReadSession(sample.path());
  ASSERT_FALSE(session.ok());
  EXPECT_NE(session.error().message.find("image_x and image_y of camera enclose"),
            std::string::npos);
}

}  // namespace
}  // namespace telestrain
