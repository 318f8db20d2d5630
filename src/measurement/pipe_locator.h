#pragma once

#include <optional>

#include "base/gray_image.h"
#include "base/result.h"
#include "calibration/array_calibration.h"
#include "geometry/cylinder.h"
#include "session/session.h"

namespace telestrain {

// Two views of one group that look at the same patch of the pipe.
struct StereoPair {
  std::string group;
  int first = 0, second = 0;                // indices into the views
  Eigen::Vector3d first_axis, second_axis;  // unit, from the camera to the object
};

// The pairs of a session: the first two views of every group. Fails (kBadInput) when a group has
// one view only or when there is one group only.
Result<std::vector<StereoPair>> StereoPairs(const Session& session, const ArrayCalibration& array);

// The pixel of the second view that shows what `pixel` of the first view shows, if the surface is
// `pipe`. Nothing when the ray misses the pipe or when the point faces away from the second view.
std::optional<Eigen::Vector2d> TransferPixel(const ArrayCalibration& array, const StereoPair& pair,
                                             const Cylinder& pipe, const Eigen::Vector2d& pixel);

struct PipeLocation {
  Cylinder pipe;
  double zncc = 0;  // between the first view and the second one seen through the pipe
};

// Where the pipe is, from one image of the pair and nothing but its nominal diameter: an exhaustive
// search over the position across the axis on reduced images, refined together with the two angles.
// The score is the correlation of locally normalised grey levels. Fails (kEstimationFailed) when
// no position makes the views agree.
Result<PipeLocation> LocatePipe(const Session& session, const ArrayCalibration& array,
                                const StereoPair& pair, const GrayImage& image);

}  // namespace telestrain
