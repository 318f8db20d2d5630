#include "diagnostics/length_uncertainty.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/numbers.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kMicrostrain = 1e6;
constexpr double kUmPerMm = 1000;

// A point as the pixels of the views of its group.
struct Sighting {
  int view = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};
using Sightings = std::vector<Sighting>;

// Nothing when all rays are parallel.
std::optional<Eigen::Vector3d> Intersection(const ArrayCalibration& array,
                                            const Sightings& sightings) {
  constexpr double kSmallestSineSquared = 1e-4;
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Sighting& sighting : sightings) {
    const ImageRay ray = array.RayOf(sighting.view, sighting.pixel);
    const Eigen::Vector3d direction = ray.direction_in_array.normalized();
    const Eigen::Matrix3d plane = Eigen::Matrix3d::Identity() - direction * direction.transpose();
    across += plane;
    sum += plane * ray.point_in_array_mm;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(across, Eigen::EigenvaluesOnly);
  if (!(solver.eigenvalues()(0) > kSmallestSineSquared)) return std::nullopt;
  return across.ldlt().solve(sum);
}

std::vector<int> ViewsOf(const ArrayCalibration& array, const std::string& group) {
  std::vector<int> views;
  for (std::size_t v = 0; v < array.views.size(); ++v)
    if (array.views[v].group == group) views.push_back(static_cast<int>(v));
  return views;
}

Sightings Middles(const Session& session, const std::vector<int>& views) {
  Sightings sightings;
  for (const int v : views)
    sightings.push_back({v, session.views[static_cast<std::size_t>(v)].region.Middle()});
  return sightings;
}

// A line between two points, as the camera sees it.
struct SeenLine {
  Sightings a, b;
};

// The lines whose lengths make up the results: at rest, shifted along and turned about every axis,
// stretched.
class Lines {
 public:
  Lines(const ArrayCalibration& array, std::vector<int> views_a, std::vector<int> views_b)
      : array_(array), views_a_(std::move(views_a)), views_b_(std::move(views_b)) {}

  void Add(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    lines_.push_back({See(views_a_, a), See(views_b_, b)});
  }
  // The length at rest, and the strains of the others against it.
  Eigen::VectorXd Measured(const ArrayCalibration& array) const {
    Eigen::VectorXd results(static_cast<Eigen::Index>(lines_.size()));
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const double length_mm =
          (*Intersection(array, lines_[i].b) - *Intersection(array, lines_[i].a)).norm();
      results(static_cast<Eigen::Index>(i)) = i == 0 ? length_mm : length_mm / results(0) - 1;
    }
    return results;
  }

 private:
  Sightings See(const std::vector<int>& views, const Eigen::Vector3d& point) const {
    Sightings sightings;
    for (const int v : views) sightings.push_back({v, array_.Project(v, point)});
    return sightings;
  }
  const ArrayCalibration& array_;
  std::vector<int> views_a_, views_b_;
  std::vector<SeenLine> lines_;
};

void AddMotions(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const LengthOptions& options,
                Lines& lines) {
  lines.Add(a, b);
  const Eigen::Vector3d middle = 0.5 * (a + b), half = 0.5 * (b - a);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d shift = options.shift_mm * Eigen::Vector3d::Unit(axis);
    lines.Add(a + shift, b + shift);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d turn = ExpRotation(options.turn_rad * Eigen::Vector3d::Unit(axis));
    lines.Add(middle - turn * half, middle + turn * half);
  }
  const double longer = 1 + options.true_strain;
  lines.Add(middle - longer * half, middle + longer * half);
}

Eigen::MatrixXd Jacobian(const ArrayCalibration& array, const Eigen::MatrixXd& cov,
                         const Lines& lines) {
  const Eigen::Index n = array.ParameterCount();
  Eigen::MatrixXd jacobian(lines.Measured(array).size(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double sigma = std::sqrt(cov(i, i));
    const Eigen::VectorXd step = sigma * Eigen::VectorXd::Unit(n, i);
    jacobian.col(i) =
        (lines.Measured(array.Perturbed(step)) - lines.Measured(array.Perturbed(-step))) /
        (2 * sigma);
  }
  return jacobian;
}

double LargestSigma(const Eigen::Matrix3d& cov) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(cov, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()(2)));
}

// A part of every result, from the covariance of `Lines::Measured`.
void SetShares(const Eigen::MatrixXd& cov, double CalibrationShare::*part,
               LengthUncertainty& uncertainty) {
  uncertainty.length_um.*part = kUmPerMm * std::sqrt(cov(0, 0));
  uncertainty.shift_microstrain.*part = kMicrostrain * LargestSigma(cov.block<3, 3>(1, 1));
  uncertainty.turn_microstrain.*part = kMicrostrain * LargestSigma(cov.block<3, 3>(4, 4));
  uncertainty.true_strain_microstrain.*part = kMicrostrain * std::sqrt(cov(7, 7));
}

// Two digits that count.
std::string Short(double value) {
  const int decimals = value > 0 ? 1 - static_cast<int>(std::floor(std::log10(value))) : 0;
  return FormatFixed(value, std::clamp(decimals, 0, 9));
}

std::string Shares(const CalibrationShare& share, const std::string& unit) {
  return Short(share.of_noise) + " " + unit + " from the noise of the calibration images alone, " +
         Short(share.of_everything) + " " + unit + " with the target's certificate";
}

std::vector<std::string> Sentences(const LengthUncertainty& u, const LengthOptions& options) {
  const double turn_deg = options.turn_rad / 0.017453292519943295;
  return {"A length of " + FormatFixed(u.length_mm, 3) + " mm between the middles of the fields " +
              u.group_a + " and " + u.group_b + " is uncertain by the calibration by " +
              Shares(u.length_um, "um") + ".",
          "A rigid shift of " + FormatShortest(options.shift_mm) +
              " mm in the worst direction feigns a strain of " +
              Shares(u.shift_microstrain, "microstrain") + ".",
          "A rigid turn of " + FormatFixed(turn_deg, 2) +
              " degrees about the worst axis feigns a strain of " +
              Shares(u.turn_microstrain, "microstrain") + ".",
          "A true strain of " + FormatFixed(options.true_strain * kMicrostrain, 0) +
              " microstrain is measured wrong by the scale of the calibration by " +
              Shares(u.true_strain_microstrain, "microstrain") + "."};
}

}  // namespace

Result<LengthUncertainty> LengthUncertaintyOf(const Session& session, const ArrayCalibration& array,
                                              const MeanMotionCovariance& covariance,
                                              const LengthOptions& options) {
  const std::vector<std::string> groups = session.Groups();
  if (groups.size() < 2)
    return EstimationFailed(
        "the session has one group of views, a length between groups needs two");
  LengthUncertainty uncertainty;
  uncertainty.group_a = groups[0];
  uncertainty.group_b = groups[1];
  const auto views_a = ViewsOf(array, groups[0]), views_b = ViewsOf(array, groups[1]);
  const auto a = Intersection(array, Middles(session, views_a));
  const auto b = Intersection(array, Middles(session, views_b));
  if (!a || !b)
    return EstimationFailed("group " + (a ? groups[1] : groups[0]) +
                            " has no two views from different directions: its points have no "
                            "depth; a length needs two such views");
  uncertainty.length_mm = (*b - *a).norm();
  Lines lines(array, views_a, views_b);
  AddMotions(*a, *b, options, lines);
  const Eigen::Index n = array.ParameterCount();
  const Eigen::MatrixXd jacobian =
      Jacobian(array, covariance.of_everything.topLeftCorner(n, n), lines);
  for (const auto& [cov, part] :
       {std::pair(&covariance.of_everything, &CalibrationShare::of_everything),
        std::pair(&covariance.of_noise, &CalibrationShare::of_noise)})
    SetShares(jacobian * cov->topLeftCorner(n, n) * jacobian.transpose(), part, uncertainty);
  uncertainty.sentences = Sentences(uncertainty, options);
  return uncertainty;
}

}  // namespace telestrain
