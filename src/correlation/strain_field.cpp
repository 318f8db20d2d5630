#include "correlation/strain_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace telestrain::correlation {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Of the spread of the window's points: below it they lie on a line.
constexpr double kSmallestSpread = 1e-3;

struct Node {
  Eigen::Vector2i offset_px;  // from the window's middle
  const SubsetMatch* match;
};

// Weights of the nodes in the two gradients of the least-squares plane: 2 x N, empty when the
// nodes lie on a line.
Eigen::Matrix2Xd SlopeWeights(const std::vector<Node>& nodes) {
  Eigen::Matrix2Xd offsets(2, nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k)
    offsets.col(static_cast<Eigen::Index>(k)) = nodes[k].offset_px.cast<double>();
  if (nodes.empty()) return {};
  offsets.colwise() -= offsets.rowwise().mean().eval();
  const Eigen::Matrix2d spread = offsets * offsets.transpose();
  if (!(spread.determinant() > kSmallestSpread * std::pow(spread.trace(), 2))) return {};
  return spread.inverse() * offsets;
}

// sum_jk w_j w_k^T rho_jk.
Eigen::Matrix2d SlopeCovariance(const std::vector<Node>& nodes, const Eigen::Matrix2Xd& weights,
                                const SubsetOverlap& overlap) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    Eigen::Vector2d along = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Eigen::Vector2i way = nodes[k].offset_px - nodes[j].offset_px;
      along += overlap.At(way.x(), way.y()) * weights.col(static_cast<Eigen::Index>(k));
    }
    sum += weights.col(static_cast<Eigen::Index>(j)) * along.transpose();
  }
  return 0.5 * (sum + sum.transpose());
}

class StrainGauge {
 public:
  StrainGauge(const FieldOptions& options, const CorrelationField& field)
      : field_(field),
        reach_(options.strain_window_points / 2),
        least_points_(
            std::max(3, static_cast<int>(std::ceil(options.min_strain_share *
                                                   std::pow(options.strain_window_points, 2))))),
        overlap_(field.subset_px, options.correlation.shape_order),
        whole_(PlaneSlopeCovariance(options.strain_window_points, field.step_px, overlap_)) {}

  void Measure(FieldPoint& point) const {
    point.strain.setConstant(kNaN);
    point.sigma_strain.setConstant(kNaN);
    if (!point.match.ok()) return;
    const std::vector<Node> nodes = Window(point);
    if (static_cast<int>(nodes.size()) < least_points_) return;
    const Eigen::Matrix2Xd weights = SlopeWeights(nodes);
    if (weights.cols() == 0) return;
    Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero(), covariance = gradient;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      gradient += nodes[k].match->shape.displacement_px *
                  weights.col(static_cast<Eigen::Index>(k)).transpose();
      covariance +=
          nodes[k].match->covariance.topLeftCorner<2, 2>() / static_cast<double>(nodes.size());
    }
    const Eigen::Matrix2d deformation = Eigen::Matrix2d::Identity() + gradient;
    point.strain = 0.5 * (gradient + gradient.transpose() + gradient.transpose() * gradient);
    const bool is_whole = static_cast<int>(nodes.size()) == (2 * reach_ + 1) * (2 * reach_ + 1);
    SetSigma(deformation, covariance, is_whole ? whole_ : SlopeCovariance(nodes, weights, overlap_),
             point);
  }

 private:
  std::vector<Node> Window(const FieldPoint& point) const {
    std::vector<Node> nodes;
    for (int row = std::max(0, point.row - reach_);
         row <= std::min(field_.rows - 1, point.row + reach_); ++row)
      for (int column = std::max(0, point.column - reach_);
           column <= std::min(field_.columns - 1, point.column + reach_); ++column) {
        const FieldPoint& other =
            field_.points[static_cast<std::size_t>(row) * field_.columns + column];
        if (other.match.ok()) nodes.push_back({other.center_px - point.center_px, &other.match});
      }
    return nodes;
  }

  // dE = sym(F^T dG); the entries (a, i), (b, j) of G have the covariance `displacement`(a, b)
  // times `slopes`(i, j).
  static void SetSigma(const Eigen::Matrix2d& f, const Eigen::Matrix2d& displacement,
                       const Eigen::Matrix2d& slopes, FieldPoint& point) {
    // Of E_ij = (f_i . dG_j + f_j . dG_i) / 2 with the columns of F and G.
    const Eigen::Matrix2d n = f.transpose() * displacement * f;
    const double xx = n(0, 0) * slopes(0, 0), yy = n(1, 1) * slopes(1, 1);
    const double xy =
        0.25 * (n(0, 0) * slopes(1, 1) + n(1, 1) * slopes(0, 0) + 2 * n(0, 1) * slopes(0, 1));
    point.sigma_strain = Eigen::Vector3d(xx, yy, xy).cwiseMax(0.0).cwiseSqrt();
  }

  const CorrelationField& field_;
  int reach_, least_points_;
  SubsetOverlap overlap_;
  Eigen::Matrix2d whole_;  // slope covariance of a window without gaps
};

}  // namespace

SubsetOverlap::SubsetOverlap(int subset_px, int shape_order)
    : side_px_(subset_px), order_(shape_order) {
  const double half = 0.5 * side_px_;
  const auto legendre2 = [&](int pixel) {
    const double x = (pixel + 0.5 - half) / half;
    return 1.5 * x * x - 0.5;
  };
  for (int shift = 0; shift < side_px_; ++shift) {
    double one_two = 0, two_one = 0, two_two = 0;
    for (int x = 0; x + shift < side_px_; ++x) {
      one_two += legendre2(x + shift);
      two_one += legendre2(x);
      two_two += legendre2(x) * legendre2(x + shift);
    }
    one_one_.push_back(side_px_ - shift);
    one_two_.push_back(one_two);
    two_one_.push_back(two_one);
    two_two_.push_back(two_two);
  }
}

double SubsetOverlap::At(int dx_px, int dy_px) const {
  const int x = std::abs(dx_px), y = std::abs(dy_px);
  if (x >= side_px_ || y >= side_px_) return 0;
  if (order_ < 2) return one_one_[x] * one_one_[y] / (one_one_[0] * one_one_[0]);
  constexpr double kWeight = -2.5;  // of P2
  const auto sum = [&](int a, int b) {
    // By symmetry a shift and its opposite give the same for P0 with P2 and P2 with P0 together.
    const double mixed = kWeight * ((one_two_[a] + two_one_[a]) * one_one_[b] +
                                    one_one_[a] * (one_two_[b] + two_one_[b]));
    const double squares = kWeight * kWeight *
                           (two_two_[a] * one_one_[b] + one_one_[a] * two_two_[b] +
                            one_two_[a] * two_one_[b] + two_one_[a] * one_two_[b]);
    return one_one_[a] * one_one_[b] + mixed + squares;
  };
  return sum(x, y) / sum(0, 0);
}

Eigen::Matrix2d PlaneSlopeCovariance(int points, int step_px, const SubsetOverlap& overlap) {
  std::vector<Node> nodes;
  for (int row = 0; row < points; ++row)
    for (int column = 0; column < points; ++column)
      nodes.push_back({step_px * Eigen::Vector2i(column - points / 2, row - points / 2), nullptr});
  return SlopeCovariance(nodes, SlopeWeights(nodes), overlap);
}

void ComputeStrain(const FieldOptions& options, CorrelationField& field) {
  const StrainGauge gauge(options, field);
  ParallelFor(field.rows, options.correlation.threads, [&](int row) {
    for (int column = 0; column < field.columns; ++column)
      gauge.Measure(field.points[static_cast<std::size_t>(row) * field.columns + column]);
  });
}

}  // namespace telestrain::correlation
