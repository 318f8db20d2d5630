#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "measurement/pipe_points.h"
#include "measurement/pipe_shape.h"
#include "measurement/uncertainty.h"

namespace telestrain {

// The pipe in the reference state: straight or bent, its diameter against the nominal one, and how
// round it is.
struct PipeGeometry {
  PipeShape shape;
  // Bent when the arc explains the points better than chance would (F-test of the two curvatures at
  // 1e-3) and when its curvature is more than three standard uncertainties.
  bool is_bent = false;
  double bending_f = 0;            // of the test
  double bending_probability = 1;  // that chance alone gives such an F
  double curvature_per_mm = 0;     // size of the fitted curvature, of a straight pipe as well
  double sigma_curvature_per_mm = 0;
  double bend_radius_mm = 0;  // of the axis; 0 when straight

  double diameter_mm = 0;
  double nominal_diameter_mm = 0;
  double deviation_um = 0;                  // measured less nominal
  double standard_uncertainty_um = 0;       // of the diameter
  std::vector<BudgetLine> budget;           // um, of the diameter
  std::vector<double> radial_deviation_mm;  // roundness: one per grid point, outwards positive
  double roundness_rms_um = 0;              // of them
  double roundness_peak_to_valley_um = 0;   // 2.5 % to 97.5 % quantile: 95 % of the points
};

// Fits the shape to the grid's points (MODEL.md 9.1). Fails (kEstimationFailed) when they do not
// determine it.
Result<PipeGeometry> MeasurePipeGeometry(const ArrayCalibration& array, const PipeGrid& grid,
                                         double nominal_diameter_mm);

// Mean viewing direction of the grid's views, from the camera to the object.
Eigen::Vector3d ViewingDirection(const PipeGrid& grid);

// Everything above but the map, for strain.json.
nlohmann::ordered_json PipeGeometryJson(const PipeGeometry& geometry);

}  // namespace telestrain
