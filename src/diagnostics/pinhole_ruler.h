#pragma once

#include <string>
#include <vector>

#include "diagnostics/pinhole_view.h"
#include "session/session.h"
#include "target/board_observation.h"

namespace telestrain {

// The ruler in one image, measured with pinhole views.
struct PinholeRulerLength {
  std::string image;
  double length_mm = 0;
  double error_um = 0;  // measured minus certified
  Eigen::Vector3d end_a_in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_b_in_array_mm = Eigen::Vector3d::Zero();
  std::string rejected_because;  // not empty: no length
};

// Lengths between the crosses of the first two groups, in the order of Session::ruler_images. An
// image with fewer than two views of a cross is rejected with the reason; none is rejected for its
// residual, which is large wherever the model is wrong.
std::vector<PinholeRulerLength> MeasureRulerWithPinhole(
    const Session& session, const std::vector<PinholeView>& views,
    const std::vector<CrossObservation>& crosses);

}  // namespace telestrain
