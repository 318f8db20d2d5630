#include "calibration/calibration_comparison.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSignificant_sigmas = 3;
constexpr int kLatticeSteps = 4;  // intervals along each side of a field
constexpr double kDepth_mm = 1;   // above and below the middle of the field
constexpr int kAlignments = 6;    // Gauss-Newton steps; the problem is nearly linear

// One point of the lattice: where it stands and in which view.
struct LatticePoint {
  std::size_t view = 0;
  Eigen::Vector3d in_array_mm;
};

std::vector<LatticePoint> Lattice(const Session& session, const ArrayCalibration& array) {
  std::vector<LatticePoint> points;
  for (std::size_t v = 0; v < array.views.size(); ++v) {
    const NominalView& nominal = session.views[v];
    const Eigen::Vector3d axis = nominal.axis_in_array.normalized();
    for (int i = 0; i <= kLatticeSteps; ++i)
      for (int j = 0; j <= kLatticeSteps; ++j) {
        const Eigen::Vector2d pixel(
            nominal.region.x + (nominal.region.width - 1.0) * i / kLatticeSteps,
            nominal.region.y + (nominal.region.height - 1.0) * j / kLatticeSteps);
        Eigen::Vector3d point = array.views[v].PointOnRay(array.LensOf(v).IdealFromPixel(pixel));
        point += axis * axis.dot(nominal.center_in_array_mm - point);
        for (const int side : {-1, 1}) points.push_back({v, point + side * kDepth_mm * axis});
      }
  }
  return points;
}

// Displacement (um on the object, image x and y of its view) of every lattice point from the old to
// the new calibration, the old one laid over the new one.
std::vector<Eigen::Vector2d> Displacements_um(const std::vector<LatticePoint>& points,
                                              const ArrayCalibration& old_array,
                                              const ArrayCalibration& new_array) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // old_from_new
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector2d> displacements_um(points.size());
  for (int step = 0; step <= kAlignments; ++step) {
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t v = points[i].view;
      const Eigen::Vector3d turned = turn * points[i].in_array_mm;
      const Eigen::Vector2d moved_px =
          Project(new_array.LensOf(v), new_array.views[v], points[i].in_array_mm) -
          Project(old_array.LensOf(v), old_array.views[v], turned + shift);
      displacements_um[i] = 1000 * moved_px.cwiseQuotient(new_array.LensOf(v).Scales_px_per_mm());
      const Eigen::Matrix<double, 2, 3> by_point =
          ProjectJacobian(old_array.LensOf(v), old_array.views[v], turned + shift);
      Eigen::Matrix<double, 2, 6> jacobian;
      jacobian << -by_point * Skew(turned), by_point;
      normal += jacobian.transpose() * jacobian;
      right += jacobian.transpose() * moved_px;
    }
    const Eigen::Matrix<double, 6, 1> delta = normal.ldlt().solve(right);
    turn = ExpRotation(delta.head<3>()) * turn;
    shift += delta.tail<3>();
  }
  return displacements_um;
}

// The linear part of a view's displacements: um and um per mm.
struct FieldMotion {
  Eigen::Vector2d shift_um = Eigen::Vector2d::Zero();
  double scale_um_per_mm = 0;
  double turn_um_per_mm = 0;
};

FieldMotion MotionOf(const std::vector<LatticePoint>& points,
                     const std::vector<Eigen::Vector2d>& displacements_um,
                     const TelecentricView& view, std::size_t index) {
  FieldMotion motion;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].view != index) continue;
    middle += view.Ideal(points[i].in_array_mm);
    motion.shift_um += displacements_um[i];
    ++count;
  }
  middle /= count;
  motion.shift_um /= count;
  double radial = 0, tangential = 0, squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].view != index) continue;
    const Eigen::Vector2d at = view.Ideal(points[i].in_array_mm) - middle;
    const Eigen::Vector2d& moved = displacements_um[i];
    radial += at.dot(moved);
    tangential += at.x() * moved.y() - at.y() * moved.x();
    squares += at.squaredNorm();
  }
  motion.scale_um_per_mm = radial / squares;
  motion.turn_um_per_mm = tangential / squares;
  return motion;
}

// How a point at rest within a group's field seems to move: the smallest displacement that fits
// what the images of the group's views moved, in the least-squares sense.
Eigen::Vector3d SeemingMotion_um(const Session& session, const ArrayCalibration& array,
                                 const std::vector<FieldMotion>& motions,
                                 const std::string& group) {
  Eigen::MatrixX3d axes(0, 3);
  Eigen::VectorXd moved_um;
  for (std::size_t v = 0; v < array.views.size(); ++v) {
    if (session.views[v].group != group) continue;
    axes.conservativeResize(axes.rows() + 2, 3);
    axes.bottomRows<2>() = array.views[v].axes_in_array;
    moved_um.conservativeResize(axes.rows());
    moved_um.tail<2>() = motions[v].shift_um;
  }
  return Eigen::MatrixXd(axes).completeOrthogonalDecomposition().solve(moved_um);
}

Eigen::Vector3d MiddleOfGroup_mm(const Session& session, const std::string& group) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const NominalView& view : session.views) {
    if (view.group != group) continue;
    sum += view.center_in_array_mm;
    ++count;
  }
  return sum / count;
}

// All changes without their uncertainties.
std::vector<Change> ChangesOf(const Session& session, const std::vector<LatticePoint>& points,
                              const ArrayCalibration& old_array,
                              const ArrayCalibration& new_array) {
  const auto displacements_um = Displacements_um(points, old_array, new_array);
  std::vector<Change> changes;
  std::vector<FieldMotion> motions;
  for (std::size_t v = 0; v < new_array.views.size(); ++v) {
    const PixelRegion& region = session.views[v].region;
    const double width_mm = region.width / new_array.LensOf(v).magnification_px_per_mm;
    motions.push_back(MotionOf(points, displacements_um, new_array.views[v], v));
    const FieldMotion& motion = motions.back();
    const std::string name = new_array.views[v].name;
    changes.push_back({"shift of the field of " + name + " along u", "um", motion.shift_um.x()});
    changes.push_back({"shift of the field of " + name + " along v", "um", motion.shift_um.y()});
    changes.push_back({"scale over the width of " + name, "um", motion.scale_um_per_mm * width_mm});
    changes.push_back({"turn over the width of " + name, "um", motion.turn_um_per_mm * width_mm});
  }
  const std::vector<std::string> groups = session.Groups();
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const Eigen::Vector3d base_mm =
        MiddleOfGroup_mm(session, groups[g]) - MiddleOfGroup_mm(session, groups[0]);
    const double seeming_um =
        base_mm.normalized().dot(SeemingMotion_um(session, new_array, motions, groups[g]) -
                                 SeemingMotion_um(session, new_array, motions, groups[0]));
    const std::string between = " of " + groups[0] + " and " + groups[g];
    // Fields that moved apart see a point at rest move back.
    changes.push_back({"distance between the fields" + between, "um", -seeming_um});
    changes.push_back({"strain that the drift" + between + " would feign", "microstrain",
                       1000 * seeming_um / base_mm.norm()});
  }
  return changes;
}

// Adds the variance that the covariance of one calibration gives to every change.
template <typename ChangesFor>
void AddVariance(const ArrayCalibration& array, const ChangesFor& changes_for,
                 std::vector<Change>& changes) {
  const Eigen::MatrixXd& covariance = array.covariance_of_noise;
  Eigen::MatrixXd gradient = Eigen::MatrixXd::Zero(changes.size(), covariance.rows());
  for (Eigen::Index p = 0; p < covariance.rows(); ++p) {
    const double step = std::sqrt(covariance(p, p));
    if (!(step > 0)) continue;
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(covariance.rows());
    delta(p) = step;
    const auto up = changes_for(array.Perturbed(delta)),
               down = changes_for(array.Perturbed(-delta));
    for (std::size_t i = 0; i < changes.size(); ++i)
      gradient(static_cast<Eigen::Index>(i), p) = (up[i].value - down[i].value) / (2 * step);
  }
  const Eigen::VectorXd variance = (gradient * covariance * gradient.transpose()).diagonal();
  for (std::size_t i = 0; i < changes.size(); ++i)
    changes[i].standard_uncertainty =
        std::hypot(changes[i].standard_uncertainty,
                   std::sqrt(std::max(0.0, variance(static_cast<Eigen::Index>(i)))));
}

}  // namespace

bool Change::IsSignificant() const {
  return std::abs(value) > kSignificant_sigmas * standard_uncertainty;
}

Result<std::vector<Change>> CompareCalibrations(const Session& session,
                                                const ArrayCalibration& old_array,
                                                const ArrayCalibration& new_array) {
  bool same = old_array.views.size() == new_array.views.size();
  for (std::size_t v = 0; same && v < new_array.views.size(); ++v)
    same = old_array.views[v].name == new_array.views[v].name;
  if (!same)
    return BadInput(
        "the two calibrations have other views; compare calibrations of one instrument");
  const std::vector<std::string> groups = session.Groups();
  for (std::size_t g = 1; g < groups.size(); ++g)
    if ((MiddleOfGroup_mm(session, groups[g]) - MiddleOfGroup_mm(session, groups[0])).norm() < 1e-3)
      return BadInput("session.toml: the groups '" + groups[0] + "' and '" + groups[g] +
                      "' have the same middle; correct center_in_array_mm of their views");
  const std::vector<LatticePoint> points = Lattice(session, new_array);
  std::vector<Change> changes = ChangesOf(session, points, old_array, new_array);
  AddVariance(
      old_array,
      [&](const ArrayCalibration& moved) { return ChangesOf(session, points, moved, new_array); },
      changes);
  AddVariance(
      new_array,
      [&](const ArrayCalibration& moved) { return ChangesOf(session, points, old_array, moved); },
      changes);
  return changes;
}

nlohmann::ordered_json ComparisonJson(const std::vector<Change>& changes,
                                      const std::string& old_name, const std::string& old_sha256) {
  Json list = Json::array();
  for (const Change& change : changes)
    list.push_back({{"quantity", change.quantity},
                    {"unit", change.unit},
                    {"value", change.value},
                    {"standard_uncertainty", change.standard_uncertainty},
                    {"significant", change.IsSignificant()}});
  return {{"schema", kComparisonSchema},
          {"compared_with", {{"file", old_name}, {"sha256", old_sha256}}},
          {"changes", list}};
}

}  // namespace telestrain
