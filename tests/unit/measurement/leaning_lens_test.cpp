// The pipe in images of a lens that is not quite telecentric, by a calibration that knows the lens.
#include <gtest/gtest.h>

#include <cmath>

#include "measurement/pipe_points.h"
#include "measurement/strain.h"
#include "simulation/experiment_truth.h"
#include "simulation/nominal_session.h"
#include "simulation/pipe_image.h"

namespace telestrain {
namespace {

constexpr double kRadius_mm = 4;
constexpr double kStretch = 750e-6;
constexpr double kRise_mm = -0.15;  // along the array's z axis

VirtualExperimentOptions Options(double telecentricity_percent_per_mm) {
  VirtualExperimentOptions options;
  options.binning = 4;
  options.telecentricity_percent_per_mm = telecentricity_percent_per_mm;
  return options;
}

// The true instrument as a calibration: with its telecentricity, or as if it were telecentric.
ArrayCalibration TrueCalibration(const VirtualInstrument& instrument, bool aware) {
  ArrayCalibration array;
  array.lenses = {instrument.lens};
  if (aware) array.lenses.front().telecentricity_per_mm = instrument.telecentricity_per_mm;
  for (const InstrumentView& view : instrument.views) array.views.push_back(view.view);
  array.covariance = Eigen::MatrixXd::Zero(array.ParameterCount(), array.ParameterCount());
  array.covariance_of_noise = array.covariance;
  return array;
}

struct Measured {
  double diameter_mm = 0;
  StateStrain raised, stretched;
};

// Noise-free images of the pipe at its place, raised, and both raised and stretched.
struct Scene {
  Session session;
  VirtualInstrument instrument;
  GrayImage reference, raised, stretched;

  explicit Scene(double telecentricity_percent_per_mm)
      : session(NominalSession(Options(telecentricity_percent_per_mm))),
        instrument(InventApparatus(Options(telecentricity_percent_per_mm), session).instrument) {
    const PaintedPipe paint = PaintPipe(instrument, kRadius_mm, 7);
    DeformedPipe pipe;
    pipe.radius_mm = kRadius_mm;
    pipe.poisson_ratio = 0.31;
    pipe.origin_in_array_mm = {0.02, -0.05, -kRadius_mm};
    reference = RenderPipe(instrument, paint, pipe, 0);
    pipe.origin_in_array_mm.z() += kRise_mm;
    raised = RenderPipe(instrument, paint, pipe, 0);
    pipe.membrane_strain = kStretch;
    stretched = RenderPipe(instrument, paint, pipe, 0);
  }

  Measured Measure(bool aware) const {
    const ArrayCalibration array = TrueCalibration(instrument, aware);
    PipeOptions correlation;
    correlation.subset_px = 17;
    const PipeTracker tracker = PipeTracker::Start(session, array, reference, correlation).value();
    const auto analyse = [&](const GrayImage& image) {
      return AnalyseState(array, tracker.grid(), tracker.Track(image).points).value();
    };
    return {2 * tracker.grid().pipe.radius_mm, analyse(raised), analyse(stretched)};
  }
};

void Record(const Measured& measured, const std::string& who) {
  const auto record = [&](const std::string& what, double value) {
    ::testing::Test::RecordProperty(who + "_" + what, std::to_string(value));
  };
  record("diameter_error_um", 1000 * (measured.diameter_mm - 2 * kRadius_mm));
  record("raised_microstrain", 1e6 * measured.raised.axial_strain);
  record("raised_local_microstrain", 1e6 * measured.raised.local_axial_strain[0]);
  record("stretch_error_microstrain", 1e6 * (measured.stretched.axial_strain - kStretch));
}

TEST(LeaningLens, IsNoneToACalibrationThatKnowsItAndSeenByOneThatDoesNot) {
  const Scene scene(0.02);
  const Measured aware = scene.Measure(true), unaware = scene.Measure(false);
  const Measured telecentric = Scene(0).Measure(true);
  Record(aware, "aware");
  Record(unaware, "unaware");
  Record(telecentric, "telecentric");

  // Half of what not knowing it makes of the diameter. Coarse subsets have an error of their own,
  // 5.5 um here, that both scenes share.
  EXPECT_NEAR(aware.diameter_mm, telecentric.diameter_mm, 0.25e-3);
  EXPECT_LT(unaware.diameter_mm, telecentric.diameter_mm - 0.25e-3);

  // A bias of 1.2e-3 px, the largest, is 0.76 microstrain of the base; it is not coherent over a
  // patch of 200 points, whose images move by different parts of a pixel.
  EXPECT_NEAR(aware.raised.axial_strain, 0, 0.3e-6);
  EXPECT_NEAR(aware.stretched.axial_strain, kStretch, 0.3e-6);

  // kappa times the rise along the axes, 30 degrees off: the patches grow by it, and their middles
  // part by it times 2.8 mm from the lens's axis of 13.85 mm of half a base.
  const double growth = 2e-4 * std::abs(kRise_mm) * 0.866;
  EXPECT_NEAR(std::abs(unaware.raised.local_axial_strain[0]), growth, 0.1 * growth);
  EXPECT_NEAR(std::abs(unaware.raised.axial_strain), growth * 2.8 / 13.85, 0.1 * growth);
}

}  // namespace
}  // namespace telestrain
