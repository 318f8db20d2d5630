#include "diagnostics/mrcal_lattice.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace telestrain {
namespace {

using Moments = Eigen::Matrix<double, 6, 1>;

// 1, x, y, x^2, x y, y^2.
Moments MomentsAt(const Eigen::Vector2d& p) {
  Moments moments;
  moments << 1, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
  return moments;
}

// Weights squared, their sum, the corners' weighted middle and covariance in the plate.
struct Cloud {
  explicit Cloud(const BoardData& board) : weights(board.Count()) {
    for (Eigen::Index i = 0; i < board.Count(); ++i) {
      const double weight = IsotropicWeight(board.whitening[static_cast<std::size_t>(i)]);
      weights(i) = weight * weight;
    }
    total = weights.sum();
    const auto places = board.corners_in_target_mm.topRows<2>();
    middle = places * weights / total;
    from_middle = places.colwise() - middle;
    covariance = from_middle * weights.asDiagonal() * from_middle.transpose() / total;
  }
  Eigen::VectorXd weights;
  double total = 0;
  Eigen::Vector2d middle;
  Eigen::Matrix2Xd from_middle;
  Eigen::Matrix2d covariance;
};

// Nodes around the corners, with their places in spacings from the corners' middle.
struct Neighbours {
  std::vector<int> nodes;
  std::vector<Eigen::Vector2d> places;
};

Neighbours NeighboursOf(const Cloud& cloud, const PlateLattice& lattice) {
  const Eigen::Vector2d low = cloud.from_middle.rowwise().minCoeff(),
                        high = cloud.from_middle.rowwise().maxCoeff();
  Neighbours around;
  for (int node = 0; node < lattice.NodeCount(); ++node) {
    const Eigen::Vector2d place = lattice.Node_mm(node) - cloud.middle;
    const double reach_mm = lattice.spacing_mm;
    if ((place.array() < low.array() - reach_mm).any() ||
        (place.array() > high.array() + reach_mm).any())
      continue;
    around.nodes.push_back(node);
    around.places.push_back(place / lattice.spacing_mm);
  }
  return around;
}

// Weights exp(MomentsAt(place) . exponent) with the wanted moments.
class GreatestEntropy {
 public:
  GreatestEntropy(const std::vector<Eigen::Vector2d>& places, const Moments& wanted)
      : wanted_(wanted) {
    for (const Eigen::Vector2d& place : places) moments_.push_back(MomentsAt(place));
  }

  // Convex: Newton's method with halved steps gets there from anywhere, if there is a solution.
  std::optional<Eigen::VectorXd> Solve(Moments exponent) const {
    constexpr int kMaxSteps = 60;
    constexpr double kEqual = 1e-13;  // of moments of order 1 and a few tens of terms
    for (int step = 0; step < kMaxSteps; ++step) {
      Moments gradient = -wanted_;
      Eigen::Matrix<double, 6, 6> curvature = Eigen::Matrix<double, 6, 6>::Zero();
      const Eigen::VectorXd weights = WeightsAt(exponent);
      for (std::size_t i = 0; i < moments_.size(); ++i) {
        const double weight = weights(static_cast<Eigen::Index>(i));
        gradient += weight * moments_[i];
        curvature += weight * moments_[i] * moments_[i].transpose();
      }
      if (gradient.cwiseAbs().maxCoeff() < kEqual * wanted_.cwiseAbs().maxCoeff()) return weights;
      const Moments change = -curvature.ldlt().solve(gradient);
      if (!change.allFinite()) return std::nullopt;
      exponent += StepLength(exponent, change, gradient.dot(change)) * change;
    }
    return std::nullopt;
  }

 private:
  Eigen::VectorXd WeightsAt(const Moments& exponent) const {
    Eigen::VectorXd weights(static_cast<Eigen::Index>(moments_.size()));
    for (std::size_t i = 0; i < moments_.size(); ++i)
      weights(static_cast<Eigen::Index>(i)) = std::exp(moments_[i].dot(exponent));
    return weights;
  }
  double DualAt(const Moments& exponent) const {
    return WeightsAt(exponent).sum() - wanted_.dot(exponent);
  }
  double StepLength(const Moments& exponent, const Moments& change, double slope) const {
    constexpr double kNearTheEnd = 1e-9;  // the dual cannot tell the difference any more
    constexpr double kShortest = 1e-6;
    if (-slope < kNearTheEnd) return 1;
    double length = 1;
    const double here = DualAt(exponent);
    while (length > kShortest &&
           !(DualAt(exponent + length * change) <= here + 0.1 * length * slope))
      length /= 2;
    return length;
  }

  std::vector<Moments> moments_;
  Moments wanted_;
};

// Best affine image of the corners about their middle.
Eigen::Matrix<double, 2, 3> AffineImage(const BoardData& board, const Cloud& cloud) {
  Eigen::Matrix3Xd basis(3, board.Count());
  basis.row(0).setOnes();
  basis.bottomRows<2>() = cloud.from_middle;
  const Eigen::MatrixX3d weighted = cloud.weights.asDiagonal() * basis.transpose();
  const Eigen::Matrix3d normal = basis * weighted;
  return (normal.llt().solve(Eigen::MatrixXd((board.pixels * weighted).transpose()))).transpose();
}

}  // namespace

double IsotropicWeight(const Eigen::Matrix2d& whitening) {
  return std::sqrt(std::abs(whitening.determinant()));
}

double LeastSpread_mm(const BoardData& board) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(Cloud(board).covariance);
  return std::sqrt(std::max(0.0, solver.eigenvalues()(0)));
}

PlateLattice LatticeOver(const CalibrationData& data) {
  constexpr double kSpacingsPerSpread = 1.7;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  double spread_mm = std::numeric_limits<double>::infinity(), height_mm = 0;
  for (const BoardData& board : data.boards) {
    low = low.cwiseMin(board.corners_in_target_mm.topRows<2>().rowwise().minCoeff());
    high = high.cwiseMax(board.corners_in_target_mm.topRows<2>().rowwise().maxCoeff());
    spread_mm = std::min(spread_mm, LeastSpread_mm(board));
    height_mm = board.corners_in_target_mm(2, 0);
  }
  PlateLattice lattice;
  lattice.spacing_mm = kSpacingsPerSpread * spread_mm;
  const Eigen::Vector2d size = (high - low) / lattice.spacing_mm;
  lattice.columns = static_cast<int>(std::ceil(size.x())) + 1;
  lattice.rows = static_cast<int>(std::ceil(size.y())) + 1;
  const Eigen::Vector2d reach =
      lattice.spacing_mm * Eigen::Vector2d(lattice.columns - 1, lattice.rows - 1);
  const Eigen::Vector2d first = (low + high - reach) / 2;
  lattice.first_node_in_target_mm = {first.x(), first.y(), height_mm};
  return lattice;
}

std::optional<CondensedBoard> Condense(const BoardData& board, const PlateLattice& lattice) {
  const Cloud cloud(board);
  const Neighbours around = NeighboursOf(cloud, lattice);
  const Eigen::Matrix2d covariance = cloud.covariance / (lattice.spacing_mm * lattice.spacing_mm);
  Moments wanted, normal;
  wanted << 1, 0, 0, covariance(0, 0), covariance(0, 1), covariance(1, 1);
  // Gauss's distribution has the moments but for the lattice's steps and ends.
  const Eigen::Matrix2d inverse = covariance.inverse();
  normal << -std::log(2 * 3.141592653589793) - 0.5 * std::log(covariance.determinant()), 0, 0,
      -0.5 * inverse(0, 0), -inverse(0, 1), -0.5 * inverse(1, 1);
  if (!normal.allFinite()) return std::nullopt;
  const auto weights = GreatestEntropy(around.places, wanted).Solve(normal);
  if (!weights) return std::nullopt;
  const Eigen::Matrix<double, 2, 3> image = AffineImage(board, cloud);
  CondensedBoard condensed{Eigen::Matrix2Xd::Zero(2, lattice.NodeCount()),
                           Eigen::VectorXd::Zero(lattice.NodeCount())};
  for (std::size_t i = 0; i < around.nodes.size(); ++i) {
    const int node = around.nodes[i];
    const Eigen::Vector2d place_mm = lattice.spacing_mm * around.places[i];
    condensed.pixels.col(node) = image * Eigen::Vector3d(1, place_mm.x(), place_mm.y());
    condensed.weight_1_px(node) = std::sqrt(cloud.total * (*weights)(static_cast<Eigen::Index>(i)));
  }
  return condensed;
}

}  // namespace telestrain
