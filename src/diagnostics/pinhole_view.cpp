#include "diagnostics/pinhole_view.h"

#include <Eigen/LU>
#include <cmath>

#include "base/check.h"

namespace telestrain {
namespace {

constexpr std::array<int, 5> kPower{2, 4, 1, 1, 6};  // of a length in k1, k2, p1, p2, k3

// Brown's formula is the same for both kinds of lens, in mm of the plane at the working distance.
TelecentricLens PlaneLens(const PinholeView& view) {
  TelecentricLens lens;
  lens.magnification_px_per_mm = view.scale_px_per_mm;
  lens.distortion = view.distortion;
  return lens;
}

Eigen::Vector2d Flip(const PinholeView& view, const Eigen::Vector2d& from_principal_px) {
  return {view.flipped ? -from_principal_px.x() : from_principal_px.x(), from_principal_px.y()};
}

// Normal equations for the point: `rows` of 2 equations each.
struct PointEquations {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();

  void Add(const Eigen::Matrix<double, 2, 3>& rows, const Eigen::Vector2d& values) {
    normal += rows.transpose() * rows;
    right += rows.transpose() * values;
  }
  std::optional<Eigen::Vector3d> Solve() const {
    // Of two views at an angle phi the determinant of the unit normal matrix is about phi^2.
    constexpr double kSmallestDeterminant = 1e-6;
    const double mean = normal.trace() / 3;
    if (!(normal.determinant() > kSmallestDeterminant * mean * mean * mean)) return std::nullopt;
    return Eigen::Vector3d(normal.inverse() * right);
  }
};

// X - (x / D) Z = 0 and the same for Y: linear in the point.
void AddLinear(const PinholeView& view, const Eigen::Vector2d& plane_mm, PointEquations& sums) {
  const Eigen::Vector2d slope = plane_mm / view.working_distance_mm;
  const Eigen::RowVector3d depth_row = view.camera_from_array.row(2);
  sums.Add(view.camera_from_array.topRows<2>() - slope * depth_row,
           slope * view.origin_in_camera_mm.z() - view.origin_in_camera_mm.head<2>());
}

// The same equations divided by the depth at `point`: their residual is the one in the image, px.
bool AddReprojection(const PinholeView& view, const Eigen::Vector2d& plane_mm,
                     const Eigen::Vector3d& point, PointEquations& sums) {
  const Eigen::Vector3d in_camera = view.camera_from_array * point + view.origin_in_camera_mm;
  if (!(in_camera.z() > 0)) return false;
  const double enlargement = view.working_distance_mm / in_camera.z();
  const Eigen::Vector2d predicted_mm = enlargement * in_camera.head<2>();
  const Eigen::Matrix<double, 2, 3> plane_from_point =
      enlargement * view.camera_from_array.topRows<2>() -
      predicted_mm / in_camera.z() * view.camera_from_array.row(2);
  sums.Add(view.scale_px_per_mm * plane_from_point,
           view.scale_px_per_mm * (plane_mm - predicted_mm));
  return true;
}

}  // namespace

std::array<double, 5> PinholeView::DistortionOfOpenCv() const {
  std::array<double, 5> of_slopes{};
  for (std::size_t i = 0; i < of_slopes.size(); ++i)
    of_slopes[i] = distortion[i] * std::pow(working_distance_mm, kPower[i]);
  return of_slopes;
}

void PinholeView::SetDistortionOfOpenCv(const std::array<double, 5>& of_slopes) {
  for (std::size_t i = 0; i < of_slopes.size(); ++i)
    distortion[i] = of_slopes[i] / std::pow(working_distance_mm, kPower[i]);
}

std::optional<Eigen::Vector2d> PinholeView::Project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d in_camera = camera_from_array * point + origin_in_camera_mm;
  if (!(in_camera.z() > 0)) return std::nullopt;
  const Eigen::Vector2d plane_mm = working_distance_mm / in_camera.z() * in_camera.head<2>();
  return principal_px + Flip(*this, PlaneLens(*this).PixelFromIdeal(plane_mm));
}

Eigen::Vector2d PinholeView::PlaneFromPixel(const Eigen::Vector2d& pixel) const {
  return PlaneLens(*this).IdealFromPixel(Flip(*this, pixel - principal_px));
}

std::optional<Eigen::Vector3d> Triangulate(const std::vector<PinholeView>& views,
                                           const std::vector<PinholeMeasurement>& measurements) {
  TELESTRAIN_CHECK(measurements.size() >= 2, "two views are needed for a point");
  std::vector<Eigen::Vector2d> planes_mm;
  PointEquations linear;
  for (const PinholeMeasurement& measured : measurements) {
    const PinholeView& view = views[static_cast<std::size_t>(measured.view)];
    planes_mm.push_back(view.PlaneFromPixel(measured.pixel));
    AddLinear(view, planes_mm.back(), linear);
  }
  std::optional<Eigen::Vector3d> point = linear.Solve();
  constexpr int kGaussNewtonSteps = 4;  // from the linear start each gains several digits
  for (int step = 0; step < kGaussNewtonSteps && point; ++step) {
    PointEquations sums;
    for (std::size_t i = 0; i < measurements.size(); ++i)
      if (!AddReprojection(views[static_cast<std::size_t>(measurements[i].view)], planes_mm[i],
                           *point, sums))
        return std::nullopt;
    const auto change = sums.Solve();
    point = change ? std::optional<Eigen::Vector3d>(*point + *change) : std::nullopt;
  }
  return point;
}

}  // namespace telestrain
