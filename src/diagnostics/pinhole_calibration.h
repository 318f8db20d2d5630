#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.h"
#include "diagnostics/pinhole_view.h"

namespace telestrain {

// The pinhole arm of the paper's section 3: the same labelled corners, with the same weights,
// calibrated with a conventional pinhole model a view.

struct PinholeOptions {
  // D of the start: the object lies this far before every camera, focal length = m D. An array
  // that is telecentric has no D of its own, so the result must be stated with it.
  double working_distance_mm = 1000;
  // The focal length stays m D. A free one has no finite optimum on telecentric corners: it grows
  // until the solver gives up.
  bool lock_core = true;
  // Brown's k1, k2, p1, p2, k3 of every view, as OpenCV's users free them; false: none.
  bool free_distortion = false;
  // Where the principal point is fixed: at the middle of the sensor, where the one lens has its
  // axis, or (false) at the middle of the view's region, as if it came from a camera of its own.
  bool principal_at_sensor_middle = false;
  int max_iterations = 100;
};

struct PinholeCalibration {
  std::vector<PinholeView> views;           // one per Session::views
  std::vector<TargetPose> poses;            // one per CalibrationData::images
  std::vector<Eigen::Matrix2Xd> errors_px;  // per board, column per corner: measured - predicted
  ReprojectionStatistics all;
  std::vector<ReprojectionStatistics> of_view;  // one per view
  int iterations = 0;
  bool hit_iteration_limit = false;
  // Largest focal length over its start m D; far above 1 with a free core: no finite optimum.
  double focal_length_growth = 1;
  std::string termination;  // the solver's own words
};

// Fills `all` and `of_view` from errors_px.
void CountErrors(const CalibrationData& data, PinholeCalibration& calibration);

// Global bundle adjustment over the views and all poses of the target, whose boards lie on one
// plate. Starts at the telecentric solution seen from D; the principal point is fixed; a view
// behind an odd number of mirrors is flipped (PinholeView). Held fixed: the pose seen by the most
// views. The stage is not used. One thread, the same bytes on every run. Fails (kEstimationFailed)
// when the solver cannot evaluate the model.
Result<PinholeCalibration> CalibratePinhole(const Session& session, const CalibrationData& data,
                                            const ArrayState& telecentric,
                                            const PinholeOptions& options);

// What the adjustment starts from: every view as a pinhole camera at the working distance from the
// middle of what it saw of the target. Of the view's lens it takes scale and axis: a pinhole view
// has square pixels, so an aspect is left to the residuals, and its perspective of 1 / D stands in
// the place of the telecentricity (a lens of telecentricity kappa is a pinhole 1 / kappa away).
std::vector<PinholeView> PinholeViewsAt(const Session& session, const CalibrationData& data,
                                        const ArrayState& telecentric,
                                        const PinholeOptions& options);

}  // namespace telestrain
