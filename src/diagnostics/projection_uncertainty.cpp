#include "diagnostics/projection_uncertainty.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr Eigen::Index kPerView = 5;  // rotation, offset

// The array with one parameter of a lens a standard deviation larger and smaller.
struct Neighbours {
  ArrayCalibration larger, smaller;
  double difference = 0;  // of the parameter
};

std::vector<Neighbours> NeighboursOf(const ArrayCalibration& array,
                                     const MeanMotionCovariance& covariance) {
  const Eigen::Index n = array.ParameterCount();
  TELESTRAIN_CHECK(covariance.of_everything.rows() == n + 6 && covariance.of_noise.rows() == n + 6,
                   "the covariance is that of the array and the mean motion");
  ArrayCalibration plain = array;
  plain.covariance = plain.covariance_of_noise = Eigen::MatrixXd();
  std::vector<Neighbours> neighbours;
  const Eigen::Index of_lenses = n - kPerView * static_cast<Eigen::Index>(array.views.size());
  for (Eigen::Index i = 0; i < of_lenses; ++i) {
    const double sigma = std::sqrt(covariance.of_everything(i, i));
    TELESTRAIN_CHECK(sigma > 0, "every estimated parameter has an uncertainty");
    const Eigen::VectorXd step = sigma * Eigen::VectorXd::Unit(n, i);
    neighbours.push_back({plain.Perturbed(step), plain.Perturbed(-step), 2 * sigma});
  }
  return neighbours;
}

// d(pixel) by the parameters and the mean motion. A view that turns by w about its axes R shows the
// point as if it moved by R^T (w x R P), one that is offset by t as if it moved by A^T t.
Eigen::Matrix2Xd PixelJacobian(const ArrayCalibration& array,
                               const std::vector<Neighbours>& neighbours, int view,
                               const Eigen::Vector3d& point_in_array_mm) {
  const auto index = static_cast<std::size_t>(view);
  const Eigen::Index n = array.ParameterCount();
  Eigen::Matrix2Xd jacobian = Eigen::Matrix2Xd::Zero(2, n + 6);
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    jacobian.col(static_cast<Eigen::Index>(i)) =
        (neighbours[i].larger.Project(view, point_in_array_mm) -
         neighbours[i].smaller.Project(view, point_in_array_mm)) /
        neighbours[i].difference;
  const Eigen::Matrix<double, 2, 3> by_point =
      ProjectJacobian(array.LensOf(index), array.views[index], point_in_array_mm);
  const Eigen::Matrix3d rotation = array.views[index].Rotation();
  const Eigen::Index of_view =
      static_cast<Eigen::Index>(neighbours.size()) + kPerView * static_cast<Eigen::Index>(view);
  jacobian.middleCols<3>(of_view) =
      -by_point * rotation.transpose() * Skew(rotation * point_in_array_mm);
  jacobian.middleCols<2>(of_view + 3) = by_point * array.views[index].axes_in_array.transpose();
  jacobian.middleCols<3>(n) = -by_point * Skew(point_in_array_mm);
  jacobian.rightCols<3>() = by_point;
  return jacobian;
}

double LargestSigma(const Eigen::Matrix2d& cov) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(cov, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()(1)));
}

ProjectionUncertainty Propagated(const Eigen::Matrix2Xd& jacobian, const Eigen::MatrixXd& cov,
                                 const TelecentricLens& lens) {
  ProjectionUncertainty uncertainty;
  const Eigen::Matrix2Xd half = jacobian * cov;
  uncertainty.cov_px2 = half.lazyProduct(jacobian.transpose());
  uncertainty.cov_px2(1, 0) = uncertainty.cov_px2(0, 1);
  uncertainty.worst_px = LargestSigma(uncertainty.cov_px2);
  const Eigen::Vector2d um_per_px = 1000 * lens.Scales_px_per_mm().cwiseInverse();
  uncertainty.worst_um =
      LargestSigma(um_per_px.asDiagonal() * uncertainty.cov_px2 * um_per_px.asDiagonal());
  return uncertainty;
}

MapNode NodeAt(const ArrayCalibration& array, const MeanMotionCovariance& covariance,
               const std::vector<Neighbours>& neighbours, int view, const Eigen::Vector2d& pixel,
               double depth_mm) {
  const Eigen::Vector3d point = array.RayOf(view, pixel).At(depth_mm);
  const Eigen::Matrix2Xd jacobian = PixelJacobian(array, neighbours, view, point);
  const TelecentricLens& lens = array.LensOf(static_cast<std::size_t>(view));
  return {pixel, Propagated(jacobian, covariance.of_everything, lens),
          Propagated(jacobian, covariance.of_noise, lens)};
}

MapSummary Summarise(const std::vector<MapNode>& nodes, ProjectionUncertainty MapNode::*part) {
  MapSummary summary;
  const auto count = static_cast<double>(nodes.size());
  for (const MapNode& node : nodes) {
    const ProjectionUncertainty& uncertainty = node.*part;
    summary.mean_px += uncertainty.worst_px / count;
    summary.mean_um += uncertainty.worst_um / count;
    summary.largest_px = std::max(summary.largest_px, uncertainty.worst_px);
    summary.largest_um = std::max(summary.largest_um, uncertainty.worst_um);
  }
  return summary;
}

}  // namespace

MapNode UncertaintyAt(const ArrayCalibration& array, const MeanMotionCovariance& covariance,
                      int view, const Eigen::Vector2d& pixel, double depth_mm) {
  return NodeAt(array, covariance, NeighboursOf(array, covariance), view, pixel, depth_mm);
}

std::vector<UncertaintyMap> UncertaintyMaps(const Session& session, const ArrayCalibration& array,
                                            const MeanMotionCovariance& covariance,
                                            const MapOptions& options) {
  TELESTRAIN_CHECK(session.views.size() == array.views.size(), "the array is the session's");
  TELESTRAIN_CHECK(options.columns >= 2 && options.rows >= 2, "two nodes a side or more");
  const std::vector<Neighbours> neighbours = NeighboursOf(array, covariance);
  std::vector<UncertaintyMap> maps;
  for (std::size_t v = 0; v < array.views.size(); ++v) {
    const PixelRegion& region = session.views[v].region;
    UncertaintyMap& map = maps.emplace_back();
    map.view = array.views[v].name;
    map.columns = options.columns;
    map.rows = options.rows;
    map.depth_mm = options.depth_mm;
    for (int i = 0; i < options.columns * options.rows; ++i) {
      const Eigen::Vector2d share(double(i % options.columns) / (options.columns - 1),
                                  double(i / options.columns) / (options.rows - 1));
      const Eigen::Vector2d pixel(region.x + share.x() * (region.width - 1),
                                  region.y + share.y() * (region.height - 1));
      map.nodes.push_back(
          NodeAt(array, covariance, neighbours, static_cast<int>(v), pixel, options.depth_mm));
    }
    map.of_everything = Summarise(map.nodes, &MapNode::of_everything);
    map.of_noise = Summarise(map.nodes, &MapNode::of_noise);
  }
  return maps;
}

}  // namespace telestrain
