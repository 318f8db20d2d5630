#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "session/session.h"
#include "tests/unit/session/sample_folder.h"

namespace telestrain {
namespace {

Session ReadOrFail(const std::filesystem::path& folder) {
  const auto session = ReadSession(folder);
  if (!session) throw std::runtime_error(session.error().message);
  return *session;
}

void ExpectEqualViews(const NominalView& a, const NominalView& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.group, b.group);
  EXPECT_EQ(a.region.x, b.region.x);
  EXPECT_EQ(a.region.y, b.region.y);
  EXPECT_EQ(a.region.width, b.region.width);
  EXPECT_EQ(a.region.height, b.region.height);
  EXPECT_EQ(a.image_x_in_array, b.image_x_in_array);
  EXPECT_EQ(a.image_y_in_array, b.image_y_in_array);
  EXPECT_EQ(a.axis_in_array, b.axis_in_array);
  EXPECT_EQ(a.center_in_array_mm, b.center_in_array_mm);
  ASSERT_EQ(a.mirrors.size(), b.mirrors.size());
  for (std::size_t i = 0; i < a.mirrors.size(); ++i) {
    EXPECT_EQ(a.mirrors[i].point_mm, b.mirrors[i].point_mm);
    EXPECT_EQ(a.mirrors[i].normal, b.mirrors[i].normal);
  }
}

void ExpectEqualInstruments(const Session& a, const Session& b) {
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.sensor.width_px, b.sensor.width_px);
  EXPECT_EQ(a.sensor.height_px, b.sensor.height_px);
  EXPECT_EQ(a.sensor.pixel_pitch_um, b.sensor.pixel_pitch_um);
  EXPECT_EQ(a.lens_magnification, b.lens_magnification);
  EXPECT_EQ(a.depth_of_field_mm, b.depth_of_field_mm);
  EXPECT_EQ(a.stage_axis_in_array, b.stage_axis_in_array);
  EXPECT_EQ(a.stage_sigma_mm, b.stage_sigma_mm);
  ASSERT_EQ(a.camera.has_value(), b.camera.has_value());
  if (a.camera) {
    EXPECT_EQ(a.camera->position_mm, b.camera->position_mm);
    EXPECT_EQ(a.camera->axis, b.camera->axis);
    EXPECT_EQ(a.camera->image_x, b.camera->image_x);
    EXPECT_EQ(a.camera->image_y, b.camera->image_y);
  }
  ASSERT_EQ(a.views.size(), b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) ExpectEqualViews(a.views[i], b.views[i]);
}

void ExpectEqualArtefacts(const Session& a, const Session& b) {
  EXPECT_EQ(a.target.columns, b.target.columns);
  EXPECT_EQ(a.target.rows, b.target.rows);
  EXPECT_EQ(a.target.square_mm, b.target.square_mm);
  EXPECT_EQ(a.target.sigma_square_um, b.target.sigma_square_um);
  EXPECT_EQ(a.target.sigma_separation_um, b.target.sigma_separation_um);
  EXPECT_EQ(a.target.coplanarity_um, b.target.coplanarity_um);
  EXPECT_EQ(a.target.flatness_um, b.target.flatness_um);
  ASSERT_EQ(a.target.boards.size(), b.target.boards.size());
  for (std::size_t i = 0; i < a.target.boards.size(); ++i) {
    EXPECT_EQ(a.target.boards[i].group, b.target.boards[i].group);
    EXPECT_EQ(a.target.boards[i].center_in_target_mm, b.target.boards[i].center_in_target_mm);
    EXPECT_EQ(a.target.boards[i].rotation_rad, b.target.boards[i].rotation_rad);
  }
  EXPECT_EQ(a.ruler.length_mm, b.ruler.length_mm);
  EXPECT_EQ(a.ruler.sigma_length_um, b.ruler.sigma_length_um);
  EXPECT_EQ(a.pipe.outer_diameter_mm, b.pipe.outer_diameter_mm);
  EXPECT_EQ(a.pipe.poisson_ratio, b.pipe.poisson_ratio);
  EXPECT_EQ(a.pipe.material, b.pipe.material);
  EXPECT_EQ(a.pipe.thermal_expansion_per_k, b.pipe.thermal_expansion_per_k);
  EXPECT_EQ(a.pipe.sigma_thermal_expansion_per_k, b.pipe.sigma_thermal_expansion_per_k);
  EXPECT_EQ(a.pipe.sigma_temperature_k, b.pipe.sigma_temperature_k);
  EXPECT_EQ(a.pipe.gauges, b.pipe.gauges);
  EXPECT_EQ(a.acceptance.reprojection_rms_px, b.acceptance.reprojection_rms_px);
  EXPECT_EQ(a.acceptance.ruler_mpe_um, b.acceptance.ruler_mpe_um);
  EXPECT_EQ(a.acceptance.strain_error_microstrain, b.acceptance.strain_error_microstrain);
  EXPECT_EQ(a.acceptance.coverage_factor, b.acceptance.coverage_factor);
  EXPECT_EQ(a.acceptance.decision_rule, b.acceptance.decision_rule);
  EXPECT_EQ(a.document, b.document);
}

void ExpectEqualTables(const Session& a, const Session& b) {
  ASSERT_EQ(a.calibration_images.size(), b.calibration_images.size());
  for (std::size_t i = 0; i < a.calibration_images.size(); ++i) {
    EXPECT_EQ(a.calibration_images[i].image, b.calibration_images[i].image);
    EXPECT_EQ(a.calibration_images[i].pose, b.calibration_images[i].pose);
    EXPECT_EQ(a.calibration_images[i].stage_mm, b.calibration_images[i].stage_mm);
  }
  EXPECT_EQ(a.ruler_images, b.ruler_images);
  EXPECT_EQ(a.gauge_columns, b.gauge_columns);
  ASSERT_EQ(a.pipe_states.size(), b.pipe_states.size());
  for (std::size_t i = 0; i < a.pipe_states.size(); ++i) {
    EXPECT_EQ(a.pipe_states[i].image, b.pipe_states[i].image);
    EXPECT_EQ(a.pipe_states[i].cycle, b.pipe_states[i].cycle);
    EXPECT_EQ(a.pipe_states[i].step, b.pipe_states[i].step);
    EXPECT_EQ(a.pipe_states[i].time_s, b.pipe_states[i].time_s);
    EXPECT_EQ(a.pipe_states[i].gauges_microstrain, b.pipe_states[i].gauges_microstrain);
    EXPECT_EQ(a.pipe_states[i].temperature_c, b.pipe_states[i].temperature_c);
  }
}

// Writes over the folder that was read, where the images are, and reads again.
void ExpectRoundTrip(const Session& session, const std::filesystem::path& folder) {
  const auto written = WriteSession(session, folder);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const Session again = ReadOrFail(folder);
  ExpectEqualInstruments(session, again);
  ExpectEqualArtefacts(session, again);
  ExpectEqualTables(session, again);
}

TEST(WriteSessionTest, ReadingBackGivesAnEqualSession) {
  const SampleFolder sample("round_trip");
  ExpectRoundTrip(ReadOrFail(sample.path()), sample.path());
}

TEST(WriteSessionTest, ReadingBackIsExactForAwkwardValues) {
  const SampleFolder sample("awkward");
  Session session = ReadOrFail(sample.path());
  session.title = "Größe \"1\" \\ 2";
  session.document = {{"a key, with: signs", "two\nlines\t#"}, {"empty", ""}};
  session.sensor.pixel_pitch_um = 1.0 / 3.0;
  session.target.square_mm = 1e-7;
  session.views[0].center_in_array_mm = {-1.0 / 7.0, 1e5, 1e-300};
  session.target.boards[0].rotation_rad = -359.9 * std::numbers::pi / 180.0;
  session.target.boards[1].rotation_rad = 1.0 / 3.0 * std::numbers::pi / 180.0;
  session.calibration_images[0].pose = "#1, \"up\" ";
  session.calibration_images[0].stage_mm = 0.1 + 0.2;
  session.pipe_states[0].time_s.reset();
  session.pipe_states[1].gauges_microstrain = {-1.0 / 3.0, std::nullopt};
  session.acceptance.ruler_mpe_um.reset();
  ExpectRoundTrip(session, sample.path());
}

TEST(WriteSessionTest, GaugePlacesAndTemperaturesAreReadBack) {
  const SampleFolder sample("gauges");
  Session session = ReadOrFail(sample.path());
  session.pipe.thermal_expansion_per_k = 8.6e-6;
  session.pipe.sigma_thermal_expansion_per_k = 2e-7;
  session.pipe.sigma_temperature_k = 0.1;
  session.pipe.gauges.resize(2);
  session.pipe.gauges[0].column = "gauge_1_microstrain";
  session.pipe.gauges[0].angle_rad = 0.5 * std::numbers::pi;
  session.pipe.gauges[0].length_mm = 3;
  session.pipe.gauges[0].sigma_angle_rad = 1e-7 * std::numbers::pi / 180;  // no short degrees
  session.pipe.gauges[1].column = "gauge_back_microstrain";
  session.pipe.gauges[1].axial_mm = -1.25;
  session.pipe.gauges[1].angle_rad = -std::numbers::pi;
  session.pipe.gauges[1].sigma_microstrain = 1;
  session.pipe.gauges[1].sigma_angle_rad = std::numbers::pi / 180;
  session.pipe.gauges[1].reads_thermal_strain = true;
  session.pipe_states[0].temperature_c = 20;
  session.pipe_states[1].temperature_c = 21.5;
  ExpectRoundTrip(session, sample.path());
}

TEST(WriteSessionTest, MinusZeroIsReadAsZeroSoThatItIsReadBack) {
  const SampleFolder sample("minus_zero");
  sample.Replace("session.toml", "sigma_square_um = 0.25", "sigma_square_um = -0.0");
  const Session session = ReadOrFail(sample.path());
  EXPECT_FALSE(std::signbit(session.target.sigma_square_um));
  ExpectRoundTrip(session, sample.path());
}

TEST(WriteSessionTest, EmptyTablesAreLeftOutAndOldOnesGo) {
  const SampleFolder sample("no_tables");
  Session session = ReadOrFail(sample.path());
  session.ruler_images.clear();
  session.ruler = {};
  session.pipe_states.clear();
  session.gauge_columns.clear();
  session.pipe = {};
  session.document.clear();
  ExpectRoundTrip(session, sample.path());
  EXPECT_FALSE(std::filesystem::exists(sample.path() / "ruler.csv"));
  EXPECT_FALSE(std::filesystem::exists(sample.path() / "pipe.csv"));
}

TEST(WriteSessionTest, TheSameSessionGivesTheSameBytesInANewFolder) {
  const SampleFolder sample("bytes");
  const Session session = ReadOrFail(sample.path());
  ASSERT_TRUE(WriteSession(session, sample.path() / "one" / "a").ok());
  ASSERT_TRUE(WriteSession(session, sample.path() / "two").ok());
  for (const char* file : {"session.toml", "calibration.csv", "ruler.csv", "pipe.csv"})
    EXPECT_EQ(sample.Read(std::string("one/a/") + file), sample.Read(std::string("two/") + file));
  EXPECT_TRUE(sample.Read("two/session.toml").starts_with("# A recording session"));
}

TEST(WriteSessionTest, FailsWhereNothingCanBeWritten) {
  const SampleFolder sample("not_a_folder");
  const auto status = WriteSession(ReadOrFail(sample.path()), sample.path() / "ruler.csv" / "x");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kOutputFailed);
}

}  // namespace
}  // namespace telestrain
