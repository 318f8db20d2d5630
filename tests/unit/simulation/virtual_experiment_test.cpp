#include "simulation/virtual_experiment.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/files.h"
#include "base/json_file.h"
#include "session/session.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

VirtualExperimentOptions SmallExperiment() {
  VirtualExperimentOptions options;
  options.binning = 4;
  options.poses = 4;
  options.cut_off_poses = 1;
  options.ruler_images = 2;
  options.pipe_states = 3;
  options.threads = 1;
  return options;
}

// A folder of its own that is gone afterwards.
class VirtualExperiment : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(testing::TempDir()) / (std::string("virtual_experiment_") + test->name());
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  Status Write(const VirtualExperimentOptions& options, const std::string& name) {
    std::ostringstream out, err;
    Console console(out, err, false);
    return WriteVirtualExperiment(options, root_ / name, root_ / (name + ".json"), console);
  }
  nlohmann::ordered_json Truth(const std::string& name) {
    return ReadJson(root_ / (name + ".json"), "telestrain.truth/1", "telestrain simulate").value();
  }

  fs::path root_;
};

TEST_F(VirtualExperiment, WritesASessionThatReadsBack) {
  VirtualExperimentOptions options = SmallExperiment();
  options.document = {{"date", "2026-01-31"}, {"customer", "Müller \"Rohr\" GmbH"}};
  const Status written = Write(options, "session");
  ASSERT_TRUE(written.ok()) << written.error().message;
  const auto session = ReadSession(root_ / "session");
  ASSERT_TRUE(session.ok()) << session.error().message;
  EXPECT_EQ(session->document.at("date"), "2026-01-31");
  EXPECT_EQ(session->document.at("customer"), "Müller \"Rohr\" GmbH");
  EXPECT_EQ(session->document.at("report_number"), "VE-1");
  EXPECT_EQ(session->views.size(), 4U);
  EXPECT_EQ(session->calibration_images.size(), 8U);
  EXPECT_EQ(session->calibration_images[0].pose, session->calibration_images[1].pose);
  EXPECT_EQ(session->calibration_images[1].stage_mm, 1);
  EXPECT_EQ(session->ruler_images.size(), 2U);
  EXPECT_EQ(session->pipe_states.size(), 3U);
  EXPECT_EQ(session->gauge_columns.size(), 4U);
}

TEST_F(VirtualExperiment, GivesTheSameBytesForAnyNumberOfThreads) {
  VirtualExperimentOptions options = SmallExperiment();
  ASSERT_TRUE(Write(options, "one").ok());
  options.threads = 3;
  ASSERT_TRUE(Write(options, "three").ok());
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root_ / "one")) {
    if (!entry.is_regular_file()) continue;
    const fs::path path = fs::relative(entry.path(), root_ / "one");
    EXPECT_EQ(ReadFile(entry.path(), kMostResultBytes).value(),
              ReadFile(root_ / "three" / path, kMostResultBytes).value())
        << path;
    ++files;
  }
  EXPECT_EQ(files, 8 + 2 + 3 + 4);
  EXPECT_EQ(ReadFile(root_ / "one.json", kMostResultBytes).value(),
            ReadFile(root_ / "three.json", kMostResultBytes).value());
}

TEST_F(VirtualExperiment, ShowsBoardsWholeExceptThoseCutOffOnPurpose) {
  ASSERT_TRUE(Write(SmallExperiment(), "session").ok());
  const auto truth = Truth("session");
  int cut_poses = 0;
  for (const auto& image : truth["poses"]) {
    ASSERT_EQ(image["boards"].size(), 4U);
    int cut = 0;
    for (const auto& board : image["boards"]) {
      EXPECT_EQ(board["corners_px"].size(), 117U);
      if (!board["all_inside"].get<bool>()) ++cut;
    }
    const bool on_purpose = image["cut_off_on_purpose"].get<bool>();
    EXPECT_TRUE(on_purpose || cut == 0) << image["image"];
    if (on_purpose && image["stage_mm"] == 0) cut_poses += cut;
  }
  EXPECT_EQ(cut_poses, 1);
}

Eigen::Vector3d VectorOf(const nlohmann::ordered_json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

TEST_F(VirtualExperiment, DeviatesFromItsDrawingByNoMoreThanAsked) {
  const VirtualExperimentOptions options = SmallExperiment();
  ASSERT_TRUE(Write(options, "session").ok());
  const auto session = ReadSession(root_ / "session");
  ASSERT_TRUE(session.ok());
  const auto truth = Truth("session");
  const double ratio = truth["lens"]["magnification_px_per_mm"].get<double>() /
                       session->NominalMagnification_px_per_mm();
  EXPECT_LE(std::abs(ratio - 1), 0.002);
  EXPECT_NE(ratio, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    const NominalView& nominal = session->views[i];
    const auto& view = truth["views"][i];
    const double limit = std::sqrt(3) * 0.3 * M_PI / 180;
    EXPECT_LT((VectorOf(view["axis_in_array"]) - nominal.axis_in_array).norm(), limit);
    EXPECT_LT((VectorOf(view["image_x_in_array"]) - nominal.image_x_in_array).norm(), limit);
    EXPECT_LE((VectorOf(view["center_in_array_mm"]) - nominal.center_in_array_mm)
                  .lpNorm<Eigen::Infinity>(),
              0.1);
  }
}

TEST_F(VirtualExperiment, WritesMirrorsThatAgreeWithTheVectors) {
  VirtualExperimentOptions options = SmallExperiment();
  options.mirrors = true;
  options.gauges = false;
  ASSERT_TRUE(Write(options, "session").ok());
  const auto session = ReadSession(root_ / "session");
  ASSERT_TRUE(session.ok()) << session.error().message;
  EXPECT_TRUE(session->camera.has_value());
  EXPECT_EQ(session->views[2].mirrors.size(), 3U);
  EXPECT_TRUE(session->gauge_columns.empty());
}

TEST_F(VirtualExperiment, WritesSixteenBitImages) {
  VirtualExperimentOptions options = SmallExperiment();
  options.bit_depth = 16;
  ASSERT_TRUE(Write(options, "session").ok());
  const std::string png = ReadFile(root_ / "session/pipe/pipe_000.png", kMostResultBytes).value();
  ASSERT_GT(png.size(), 26U);
  EXPECT_EQ(png[24], 16);  // bit depth in the IHDR chunk
  EXPECT_EQ(png[25], 0);   // grey
}

TEST_F(VirtualExperiment, WritesEveryEffectAtOnce) {
  VirtualExperimentOptions options = SmallExperiment();
  options.bit_depth = 12;
  options.full_well_electrons = 10000;
  options.exposure = 1.2;
  options.dust_specks = 20;
  options.inverted = true;
  options.numerical_aperture = 0.02;
  options.vibration_um = 1;
  options.telecentricity_percent_per_mm = 0.1;
  options.mirror_error_mrad = 0.5;
  options.mirror_error_um = 10;
  options.warmup_drift_um = 5;
  options.pipe_bend_radius_mm = 200;
  options.torsion_max_microstrain = 300;
  options.pressure_max_mpa = 10;
  options.temperature_change_k = 10;
  options.image_interval_s = 5;
  const Status written = Write(options, "session");
  ASSERT_TRUE(written.ok()) << written.error().message;
  const auto session = ReadSession(root_ / "session");
  ASSERT_TRUE(session.ok()) << session.error().message;
  EXPECT_EQ(session->pipe_states[2].time_s, 10);
  const auto state = Truth("session")["pipe"][1];  // the full load
  // The inside of the bent axis is shorter: 1 - z / 200 mm, z = 3.8 mm on the visible arc.
  EXPECT_NEAR(state["shear_microstrain"].get<double>(), 300 / (1 - 3.8 / 200), 1);
  // p a^2 / (b^2 - a^2) (2 - n) / E, expansion and Poisson's contraction; to 1 % of the largest
  // (bending and the bent axis).
  const double hoop = 10 * 11.56 / 4.44 / 106e3 * 1.69e6 + 86 - 0.31 * 750;
  EXPECT_NEAR(state["hoop_microstrain"].get<double>(), hoop, 7.5);
}

TEST_F(VirtualExperiment, RefusesToOverwriteASession) {
  ASSERT_TRUE(Write(SmallExperiment(), "session").ok());
  const Status again = Write(SmallExperiment(), "session");
  ASSERT_FALSE(again.ok());
  EXPECT_NE(again.error().message.find("already holds a session"), std::string::npos);
}

TEST(VirtualExperimentOptions, TableCoversTheDefaults) {
  EXPECT_TRUE(CheckVirtualExperimentOptions({}).ok());
}

TEST(VirtualExperimentOptions, RefusesValuesOutsideTheirRange) {
  const auto refused = [](auto member, auto value, const std::string& expected) {
    VirtualExperimentOptions options;
    options.*member = value;
    const Status status = CheckVirtualExperimentOptions(options);
    ASSERT_FALSE(status.ok()) << expected;
    EXPECT_EQ(status.error().kind, ErrorKind::kUsage);
    EXPECT_NE(status.error().message.find(expected), std::string::npos) << status.error().message;
  };
  using Options = VirtualExperimentOptions;
  refused(&Options::noise_gray, 99.0, "noise_gray is 99 gray, wanted 0 to 20 gray");
  refused(&Options::noise_gray, std::nan(""), "noise_gray is nan");
  refused(&Options::poses, 2, "poses is 2, wanted 3 to 5000");
  refused(&Options::bit_depth, 14, "bit_depth is 14, wanted 8, 10, 12 or 16");
  refused(&Options::numerical_aperture, 0.004, "numerical_aperture is 0.004, wanted 0, or 0.005");
  refused(&Options::pipe_bend_radius_mm, -50.0, "pipe_bend_radius_mm is -50 mm, wanted 0, or 100");
  refused(&Options::pipe_states, 2, "pipe_states is 2, wanted 0 or at least 3");
  refused(&Options::wall_thickness_mm, 4.0, "wall_thickness_mm is 4 mm, wanted less than half");
  refused(&Options::binning, 5, "binning is 5, wanted 1 to 4");
  refused(&Options::cut_off_poses, 10, "cut_off_poses is 10, wanted at most poses - 3 = 9");
  refused(&Options::load_cycles, 3, "load_cycles is 3");
}

TEST_F(VirtualExperiment, WritesNothingWhenAnOptionIsRefused) {
  VirtualExperimentOptions options = SmallExperiment();
  options.psf_sigma_px = 7;
  EXPECT_FALSE(Write(options, "session").ok());
  EXPECT_FALSE(fs::exists(root_ / "session"));
}

}  // namespace
}  // namespace telestrain
