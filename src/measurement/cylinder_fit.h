#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/result.h"
#include "geometry/cylinder.h"

namespace telestrain {

struct CylinderFit {
  Cylinder cylinder;
  double sigma_diameter_mm = 0;  // from the scatter of the points about the fit
  double rms_mm = 0;             // of the distances of the points used
  std::vector<bool> used;        // one per point; the others are further than 5 robust sigmas
};

// Least-squares cylinder through surface points (array frame, mm), started from `start`, with
// outliers taken out by a robust limit. Fails (kEstimationFailed) with fewer than 20 points or when
// the points do not determine a cylinder.
Result<CylinderFit> FitCylinder(const std::vector<Eigen::Vector3d>& points_in_array_mm,
                                const Cylinder& start);

}  // namespace telestrain
