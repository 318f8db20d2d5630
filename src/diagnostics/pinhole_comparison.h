#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "diagnostics/pinhole_calibration.h"
#include "target/board_observation.h"

namespace telestrain {

// The paper's section 3 on the session's own corners and rulers: what is lost by describing a
// telecentric array with pinhole cameras? A pinhole with a free focal length has no finite optimum
// on such corners, so the working distance D is stated and the core locked at m D, for a range
// of D. libmrcal solves the locked arms (pinhole_mrcal.h). Those with five coefficients are solved
// by our own adjustment (pinhole_calibration.h), which finds the same in a twentieth of the time:
// the tests hold both against each other. Ours also keeps the two boards of the plate where its
// certificate says and gives every corner its whole covariance, so that its RMS may be a little
// larger where the coefficients bring nothing.

struct PinholeComparisonOptions {
  std::vector<double> distances_mm = {100, 1000, 1e4, 1e5};
  // With five coefficients a view.
  std::vector<double> distorted_distances_mm = {100, 1000, 1e5};
  // Wrong minima: for the arm locked at this distance our own adjustment starts from `seeds` other
  // places. Every view and pose is turned by up to seed_turn_deg about every axis, every pose moved
  // by up to seed_shift_mm.
  double seeded_distance_mm = 1000;
  int seeds = 3;
  double seed_turn_deg = 20;
  double seed_shift_mm = 1;
  int threads = 0;  // arms side by side; 0: one per core. No effect on the result.
};

// A seed ends in a wrong minimum when its RMS exceeds the best one this many times.
inline constexpr double kWrongMinimum = 1.2;
inline constexpr double kErrorBin_px = 0.02;  // mrcal's

struct PinholeArm {
  double working_distance_mm = 0;  // D
  bool five_coefficients = false;  // free in every view
  std::string solver;              // "mrcal" or "telestrain"
  ReprojectionStatistics reprojection;
  std::vector<int> histogram;  // corners by the norm of their error, bins of kErrorBin_px from 0
  std::vector<double> ruler_error_um;  // of the images that could be measured
  double ruler_rmse_um = 0, ruler_max_um = 0;
  int iterations = 0;  // of mrcal, which does not tell: runs until nothing moves
  bool converged = false;
  int starts = 0, wrong_minima = 0;  // seeds and how many of them; 0 for an arm without seeds
};

struct PinholeComparison {
  ReprojectionStatistics telecentric;  // the calibration's own, with all its terms
  std::vector<int> telecentric_histogram;
  std::vector<PinholeArm> arms;  // locked ones in the order of their distances, then distorted ones

  // Where a pinhole is as good: the smallest of the distances at which a locked one without
  // coefficients has no more than 1.01 times the telecentric RMS. Parallel rays are its limit:
  // far enough away it is a telecentric model, with a magnification for every view but without the
  // distortion of the one lens, which no pinhole with a principal point of its own can have.
  // Nothing when no distance is.
  std::optional<double> AsGoodFrom_mm() const;
};

// Fails like CalibratePinholeWithMrcal. The same bytes on every run. 36 images of four views with
// 117 corners: 1 s of CPU time.
Result<PinholeComparison> ComparePinhole(const Session& session, const CalibrationData& data,
                                         const ArrayState& state,
                                         const std::vector<CrossObservation>& crosses,
                                         const PinholeComparisonOptions& options = {});

}  // namespace telestrain
