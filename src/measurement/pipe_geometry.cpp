#include "measurement/pipe_geometry.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace telestrain {
namespace {

constexpr double kSignificance = 1e-3;           // of the test for a bent axis
constexpr std::size_t kCalibrationPoints = 400;  // enough for the smooth effect of the calibration
constexpr double kUmPerMm = 1000;

std::vector<Eigen::Vector3d> SurfacePoints(const PipeGrid& grid) {
  std::vector<Eigen::Vector3d> points;
  for (const PipePoint& point : grid.points) points.push_back(point.reference_in_array_mm);
  return points;
}

// The points of the grid through another calibration, every so many of them.
std::vector<Eigen::Vector3d> PointsThrough(const ArrayCalibration& array, const PipeGrid& grid) {
  const std::size_t stride = 1 + grid.points.size() / kCalibrationPoints;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < grid.points.size(); i += stride) {
    const PipePoint& point = grid.points[i];
    const StereoPair& pair = grid.pairs[static_cast<std::size_t>(point.group)];
    points.push_back(
        Triangulate(array,
                    {{pair.first, point.first_center_px.cast<double>(), Eigen::Matrix2d::Zero()},
                     {pair.second, point.second_pixel, Eigen::Matrix2d::Zero()}})
            .in_array_mm);
  }
  return points;
}

// Five robust standard deviations of the distances from `shape`.
double OutlierLimit_mm(const std::vector<Eigen::Vector3d>& points, const PipeShape& shape) {
  std::vector<double> distances;
  for (const auto& point : points) distances.push_back(std::abs(shape.Distance_mm(point)));
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::max(5 * 1.4826 * *middle, 1e-6);
}

ShapeFit FitRobustly(const std::vector<Eigen::Vector3d>& points, const PipeShape& start,
                     bool bent) {
  constexpr double kAll_mm = 1e9;
  const ShapeFit all = FitShape(points, start, bent, kAll_mm);
  if (!all.ok) return all;
  return FitShape(points, all.shape, bent, OutlierLimit_mm(points, all.shape));
}

// Probability of an F of two and `freedom` degrees of freedom beyond `f`; exact.
double ProbabilityOfF2(double f, double freedom) {
  return std::pow(1 + 2 * f / freedom, -freedom / 2);
}

// Diameter (um) and the two curvatures (1/mm) of the fit.
Eigen::Vector3d ResultsOf(const PipeShape& shape) {
  return {2 * kUmPerMm * shape.radius_mm, shape.curvature_per_mm.x(), shape.curvature_per_mm.y()};
}

// How the calibration enters them.
CalibrationCovariances CalibrationOf(const ArrayCalibration& array, const PipeGrid& grid,
                                     const PipeShape& shape, bool bent) {
  return CalibrationPartsOf(array, [&](const ArrayCalibration& perturbed) {
    constexpr double kAll_mm = 1e9;
    return Eigen::VectorXd(
        ResultsOf(FitShape(PointsThrough(perturbed, grid), shape, bent, kAll_mm).shape));
  });
}

// Both fits use the same points, those of the bent one.
void TestForBending(const ArrayCalibration& array, const PipeGrid& grid, const ShapeFit& bent,
                    double straight_squares_mm2, PipeGeometry& geometry) {
  const double freedom = std::max(1, bent.used - 7);
  geometry.bending_f = (straight_squares_mm2 - bent.squares_mm2) / 2 / (bent.squares_mm2 / freedom);
  geometry.bending_f = std::max(0.0, geometry.bending_f);
  geometry.bending_probability = ProbabilityOfF2(geometry.bending_f, freedom);
  const CalibrationCovariances calibration = CalibrationOf(array, grid, bent.shape, true);
  const Eigen::Matrix2d covariance = bent.covariance.bottomRightCorner<2, 2>() +
                                     calibration.noise.bottomRightCorner<2, 2>() +
                                     calibration.certificate.bottomRightCorner<2, 2>();
  const Eigen::Vector2d& curvature = bent.shape.curvature_per_mm;
  geometry.curvature_per_mm = curvature.norm();
  const Eigen::Vector2d direction = curvature.normalized();
  geometry.sigma_curvature_per_mm = std::sqrt(direction.dot(covariance * direction));
  geometry.is_bent = geometry.bending_probability < kSignificance &&
                     geometry.curvature_per_mm > 3 * geometry.sigma_curvature_per_mm;
  if (geometry.is_bent) geometry.bend_radius_mm = 1 / geometry.curvature_per_mm;
}

void FillDiameter(const ArrayCalibration& array, const PipeGrid& grid, const ShapeFit& fit,
                  PipeGeometry& geometry) {
  geometry.diameter_mm = 2 * fit.shape.radius_mm;
  geometry.deviation_um = kUmPerMm * (geometry.diameter_mm - geometry.nominal_diameter_mm);
  const CalibrationCovariances calibration =
      CalibrationOf(array, grid, fit.shape, geometry.is_bent);
  geometry.budget = {{"scatter of the points", 2 * kUmPerMm * std::sqrt(fit.covariance(4, 4))},
                     {"calibration", Sigma(calibration.noise, 0)},
                     {"target certificate", Sigma(calibration.certificate, 0)}};
  geometry.standard_uncertainty_um = Combine(geometry.budget);
}

void FillRoundness(const std::vector<Eigen::Vector3d>& points, PipeGeometry& geometry) {
  double squares = 0;
  for (const Eigen::Vector3d& point : points) {
    geometry.radial_deviation_mm.push_back(geometry.shape.Distance_mm(point));
    squares += std::pow(geometry.radial_deviation_mm.back(), 2);
  }
  geometry.roundness_rms_um = kUmPerMm * std::sqrt(squares / static_cast<double>(points.size()));
  std::vector<double> sorted = geometry.radial_deviation_mm;
  std::sort(sorted.begin(), sorted.end());
  const auto cut = static_cast<std::size_t>(0.025 * static_cast<double>(sorted.size()));
  geometry.roundness_peak_to_valley_um = kUmPerMm * (sorted[sorted.size() - 1 - cut] - sorted[cut]);
}

}  // namespace

Eigen::Vector3d ViewingDirection(const PipeGrid& grid) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const StereoPair& pair : grid.pairs) sum += pair.first_axis + pair.second_axis;
  return sum.normalized();
}

Result<PipeGeometry> MeasurePipeGeometry(const ArrayCalibration& array, const PipeGrid& grid,
                                         double nominal_diameter_mm) {
  const std::vector<Eigen::Vector3d> points = SurfacePoints(grid);
  const PipeShape start = ShapeOf(grid.pipe, ViewingDirection(grid));
  const ShapeFit straight = FitRobustly(points, start, false);
  const ShapeFit bent = straight.ok ? FitRobustly(points, straight.shape, true) : straight;
  if (!straight.ok || !bent.ok)
    return EstimationFailed("the " + std::to_string(points.size()) +
                            " measured points of the surface do not determine the pipe's shape; "
                            "look at the speckle pattern and the focus in both groups");
  PipeGeometry geometry;
  geometry.nominal_diameter_mm = nominal_diameter_mm;
  std::vector<Eigen::Vector3d> kept;
  const double limit_mm = OutlierLimit_mm(points, bent.shape);
  for (const Eigen::Vector3d& point : points)
    if (std::abs(bent.shape.Distance_mm(point)) <= limit_mm) kept.push_back(point);
  constexpr double kAll_mm = 1e9;
  // Both fits that are compared use the same points.
  const ShapeFit kept_straight = FitShape(kept, straight.shape, false, kAll_mm);
  const ShapeFit kept_bent = FitShape(kept, bent.shape, true, kAll_mm);
  if (kept_straight.ok && kept_bent.ok)
    TestForBending(array, grid, kept_bent, kept_straight.squares_mm2, geometry);
  const ShapeFit& fit = geometry.is_bent ? bent : straight;
  geometry.shape = fit.shape;
  FillDiameter(array, grid, fit, geometry);
  FillRoundness(points, geometry);
  return geometry;
}

nlohmann::ordered_json PipeGeometryJson(const PipeGeometry& geometry) {
  using Json = nlohmann::ordered_json;
  Json budget = Json::array();
  for (const BudgetLine& line : geometry.budget)
    budget.push_back(
        {{"source", line.source}, {"standard_uncertainty_um", line.standard_uncertainty}});
  const auto list = [](const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); };
  return {{"angle_0_in_array", list(geometry.shape.at_0)},
          {"angle_90_in_array", list(geometry.shape.at_90)},
          {"is_bent", geometry.is_bent},
          {"bend_radius_mm", geometry.is_bent ? Json(geometry.bend_radius_mm) : Json(nullptr)},
          {"curvature_per_mm", geometry.curvature_per_mm},
          {"sigma_curvature_per_mm", geometry.sigma_curvature_per_mm},
          {"bending_f", geometry.bending_f},
          {"bending_probability", geometry.bending_probability},
          {"diameter_mm", geometry.diameter_mm},
          {"nominal_diameter_mm", geometry.nominal_diameter_mm},
          {"deviation_um", geometry.deviation_um},
          {"standard_uncertainty_um", geometry.standard_uncertainty_um},
          {"budget", budget},
          {"roundness_rms_um", geometry.roundness_rms_um},
          {"roundness_peak_to_valley_um", geometry.roundness_peak_to_valley_um}};
}

}  // namespace telestrain
