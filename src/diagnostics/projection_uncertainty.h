#pragma once

#include <string>
#include <vector>

#include "calibration/bundle_covariance.h"
#include "session/session.h"

namespace telestrain {

// How well the calibrated views know where they project, over their fields.
//
// mrcal's method (its documentation, "Propagation of calibration-time noise to projection
// uncertainty": mean-pcam), carried over to telecentric views. A pixel is taken back to a point of
// the array's frame; the point is tied to the target in every pose, carried along by the errors of
// the poses, averaged, and projected by the view with its errors. So the result compares the view
// with the target that calibrated it, and does not depend on which pose or frame was held fixed.
// To first order
//   dq = dq/d(lens, view) g + dq/dP (w x P + d)
// with the errors g and the mean motion (w, d) of MeanMotionCovariance.
//
// A telecentric view has no distances to ask at, but a plane: where it looks along P, errors of its
// direction grow with the distance from the middle of the poses.

struct MapOptions {
  int columns = 20, rows = 15;  // nodes over each view's region, from its first to its last pixel
  double depth_mm = 0;          // of the plane across the view, beyond its nominal middle
};

// Of the projection of one point, one standard deviation.
struct ProjectionUncertainty {
  Eigen::Matrix2d cov_px2 = Eigen::Matrix2d::Zero();
  double worst_px = 0;  // in the direction in which it is largest
  double worst_um = 0;  // the same on the object
};

struct MapNode {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // on the whole sensor
  ProjectionUncertainty of_everything;  // the noise of the images and the target's certificate
  ProjectionUncertainty of_noise;       // the target taken to be exactly as certified
};

struct MapSummary {
  double mean_px = 0, largest_px = 0, mean_um = 0, largest_um = 0;  // of `worst` over the nodes
};

struct UncertaintyMap {
  std::string view;
  int columns = 0, rows = 0;
  double depth_mm = 0;
  std::vector<MapNode> nodes;  // columns x rows, u running fastest
  MapSummary of_everything, of_noise;
};

// One map per view of the session, which are those of `array` in their order. `covariance` is that
// of CovarianceWithMeanMotion at the state of `array`. Derivatives by the lens are central
// differences over one standard deviation, the others analytic. Throws std::logic_error when the
// covariance is of another array or the grid has fewer than two nodes a side.
std::vector<UncertaintyMap> UncertaintyMaps(const Session& session, const ArrayCalibration& array,
                                            const MeanMotionCovariance& covariance,
                                            const MapOptions& options = {});

// Of one pixel at a depth.
MapNode UncertaintyAt(const ArrayCalibration& array, const MeanMotionCovariance& covariance,
                      int view, const Eigen::Vector2d& pixel, double depth_mm);

}  // namespace telestrain
