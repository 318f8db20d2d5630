#include "measurement/strain_model.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace telestrain {
namespace {

constexpr double kWidestArc_rad = 50 * std::numbers::pi / 180;  // beyond it nothing correlates
constexpr int kArcSamples = 2000;

struct FieldOfView {
  TelecentricView view;
  PixelRegion region;
};

bool Sees(const TelecentricLens& lens, const FieldOfView& field, const Eigen::Vector3d& point_mm) {
  const Eigen::Vector2d pixel = Project(lens, field.view, point_mm);
  const PixelRegion& region = field.region;
  return pixel.x() >= region.x - 0.5 && pixel.x() < region.x + region.width - 0.5 &&
         pixel.y() >= region.y - 0.5 && pixel.y() < region.y + region.height - 0.5;
}

// The nominal pipe that touches the middle of the field from below.
PipeShape NominalPipe(const NominalView& a, const NominalView& b, double radius_mm) {
  const Eigen::Vector3d viewing = (a.axis_in_array + b.axis_in_array).normalized();
  Cylinder cylinder;
  cylinder.radius_mm = radius_mm;
  cylinder.axis = Eigen::Vector3d::UnitX();
  cylinder.axis_point_mm = 0.5 * (a.center_in_array_mm + b.center_in_array_mm);
  PipeShape shape = ShapeOf(cylinder, viewing);
  shape.origin_in_array_mm = cylinder.axis_point_mm - radius_mm * shape.at_0;
  return shape;
}

}  // namespace

std::optional<double> MeanFibre_mm(const Session& session) {
  std::vector<const NominalView*> pair;
  for (const NominalView& view : session.views)
    if (view.group == session.views.front().group) pair.push_back(&view);
  if (pair.size() < 2) return {};
  const double radius_mm = session.pipe.outer_diameter_mm / 2;
  const PipeShape pipe = NominalPipe(*pair[0], *pair[1], radius_mm);
  const TelecentricLens lens = session.NominalLens();
  const FieldOfView first{session.NominalTelecentricView(*pair[0]), pair[0]->region};
  const FieldOfView second{session.NominalTelecentricView(*pair[1]), pair[1]->region};
  double sum_mm = 0;
  int count = 0;
  for (int i = 0; i < kArcSamples; ++i) {
    const double angle = kWidestArc_rad * ((2.0 * i + 1) / kArcSamples - 1);
    const Eigen::Vector3d point =
        pipe.InArray({0, radius_mm * std::sin(angle), radius_mm * std::cos(angle)});
    if (!Sees(lens, first, point) || !Sees(lens, second, point)) continue;
    sum_mm += radius_mm * std::cos(angle);
    ++count;
  }
  if (count == 0) return {};
  return sum_mm / count;
}

StrainModel MakeStrainModel(const PipeGrid& grid) {
  StrainModel model;
  model.shape = ShapeOf(grid.pipe, ViewingDirection(grid));
  model.sigma_axis_mm = grid.sigma_diameter_mm / 2;
  return model;
}

StrainModel MakeStrainModel(const Session& session, const PipeGrid& grid,
                            const PipeGeometry& geometry) {
  StrainModel model = MakeStrainModel(grid);
  model.shape = geometry.shape;
  model.poisson_ratio = session.pipe.poisson_ratio;
  // Depth and radius of an arc are found together; the nominal diameter checks them.
  model.sigma_axis_mm =
      1e-3 * std::hypot(geometry.standard_uncertainty_um, geometry.deviation_um) / 2;
  if (const auto towards_0_mm = MeanFibre_mm(session))
    model.fibre_mm = Eigen::Vector2d(0, *towards_0_mm);
  model.gauges = session.pipe.gauges;
  model.thermal_expansion_per_k = session.pipe.thermal_expansion_per_k;
  model.sigma_thermal_expansion_per_k = session.pipe.sigma_thermal_expansion_per_k;
  model.sigma_temperature_k = session.pipe.sigma_temperature_k;
  model.half_depth_of_field_mm = session.depth_of_field_mm / 2;
  return model;
}

}  // namespace telestrain
