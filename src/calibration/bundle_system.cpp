#include "calibration/bundle_system.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/check.h"
#include "calibration/bundle_covariance.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Where the numbers of a parameter block stand: -1 for one that is held fixed.
struct BlockPlace {
  std::vector<Eigen::Index> at;
  Eigen::Index group = -1;  // a pose block, else global
};
using Places = std::unordered_map<const double*, BlockPlace>;

Places PlaceParameters(const std::vector<GlobalBlock>& globals, const BundleBlocks& blocks,
                       BundleSystem& system) {
  Places places;
  Eigen::Index next = 0;
  for (const GlobalBlock& block : globals) {
    BlockPlace place;
    for (std::size_t i = 0; i < block.free.size(); ++i) {
      place.at.push_back(block.free[i] ? next : -1);
      if (!block.free[i]) continue;
      system.names.push_back(block.names[i]);
      (IsAdjusted(block, i) ? system.adjusted : system.considered).push_back(next);
      ++next;
    }
    if (block.kind == GlobalBlock::kLens || block.kind == GlobalBlock::kView)
      system.array_size = next;
    places.emplace(block.values, std::move(place));
  }
  system.global = Eigen::MatrixXd::Zero(next, next);
  system.priors = Eigen::VectorXd::Zero(next);
  const PosePlace& gauge = blocks.place_of_image[blocks.gauge_pose];
  for (std::size_t g = 0; g < blocks.groups.size(); ++g) {
    const auto size = static_cast<Eigen::Index>(blocks.groups[g].Size());
    BlockPlace place;
    place.group = static_cast<Eigen::Index>(g);
    for (Eigen::Index i = 0; i < size; ++i)
      place.at.push_back(g == gauge.group && i / kPoseSize == gauge.slot ? -1 : i);
    places.emplace(blocks.groups[g].values, std::move(place));
    system.groups.push_back({Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, next)});
  }
  return places;
}

// Writes the derivatives of a term by its free parameters side by side, those of the pose block
// last, and finds where they belong.
class Linearisation {
 public:
  void Evaluate(const BundleTerm& term, const Places& places);
  // weight J^T J.
  Eigen::MatrixXd Square(double weight) const;

  std::vector<Eigen::Index> global_at, pose_at;
  Eigen::Index group = -1;

 private:
  Eigen::MatrixXd columns_;  // of J
  std::vector<std::vector<double>> jacobians_;
  std::vector<double> residuals_;
};

void Linearisation::Evaluate(const BundleTerm& term, const Places& places) {
  const std::vector<int>& sizes = term.residual->parameter_block_sizes();
  const Eigen::Index n = term.residual->num_residuals();
  residuals_.resize(static_cast<std::size_t>(n));
  jacobians_.resize(sizes.size());
  std::vector<double*> pointers;
  Eigen::Index count = 0;
  for (std::size_t b = 0; b < sizes.size(); ++b) {
    jacobians_[b].resize(static_cast<std::size_t>(n * sizes[b]));
    pointers.push_back(jacobians_[b].data());
    count += sizes[b];
  }
  TELESTRAIN_CHECK(term.residual->Evaluate(term.blocks.data(), residuals_.data(), pointers.data()),
                   "the covariance is asked for where the residuals can be evaluated");
  columns_.resize(n, count);
  global_at.clear();
  pose_at.clear();
  Eigen::Index column = 0;
  for (const bool of_pose : {false, true})
    for (std::size_t b = 0; b < sizes.size(); ++b) {
      const BlockPlace& place = places.at(term.blocks[b]);
      if ((place.group >= 0) != of_pose) continue;
      if (of_pose) group = place.group;
      const Eigen::Map<const RowMatrix> rows(pointers[b], n, sizes[b]);
      for (std::size_t i = 0; i < place.at.size(); ++i) {
        if (place.at[i] < 0) continue;
        columns_.col(column++) = rows.col(static_cast<Eigen::Index>(i));
        (of_pose ? pose_at : global_at).push_back(place.at[i]);
      }
    }
  columns_.conservativeResize(Eigen::NoChange, column);
}

Eigen::MatrixXd Linearisation::Square(double weight) const {
  const Eigen::Index n = columns_.cols();
  Eigen::MatrixXd square(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      square(i, j) = square(j, i) = weight * columns_.col(i).dot(columns_.col(j));
  return square;
}

void AddTerm(const BundleTerm& term, const Places& places, double weight, Linearisation& linear,
             BundleSystem& system) {
  linear.Evaluate(term, places);
  const Eigen::MatrixXd square = linear.Square(weight);
  const auto globals = static_cast<Eigen::Index>(linear.global_at.size());
  const auto poses = static_cast<Eigen::Index>(linear.pose_at.size());
  for (Eigen::Index i = 0; i < globals; ++i)
    for (Eigen::Index j = 0; j < globals; ++j)
      system.global(linear.global_at[i], linear.global_at[j]) += square(i, j);
  for (Eigen::Index i = 0; i < poses; ++i) {
    GroupSystem& group = system.groups[static_cast<std::size_t>(linear.group)];
    for (Eigen::Index j = 0; j < globals; ++j)
      group.coupling(linear.pose_at[i], linear.global_at[j]) += square(globals + i, j);
    for (Eigen::Index j = 0; j < poses; ++j)
      group.block(linear.pose_at[i], linear.pose_at[j]) += square(globals + i, globals + j);
  }
  if (term.residual->parameter_block_sizes().size() == 1)
    for (Eigen::Index i = 0; i < globals; ++i) system.priors(linear.global_at[i]) += square(i, i);
}

// The lens in its own units, left perturbations instead of rotation vectors.
Eigen::MatrixXd NamedFromSolver(const std::vector<GlobalBlock>& globals, Eigen::Index size) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::Index next = 0;
  for (const GlobalBlock& block : globals) {
    if (block.kind == GlobalBlock::kView) {
      matrix.block<3, 3>(next, next) =
          LeftJacobian(Eigen::Map<const Eigen::Vector3d>(block.values));
      matrix.block<2, 2>(next + 3, next + 3).setIdentity();
      next += kViewSize;
      continue;
    }
    for (std::size_t i = 0; i < block.free.size(); ++i)
      if (block.free[i]) matrix(next, next) = block.unit[i], ++next;
  }
  return matrix;
}

// Inverse of a positive definite matrix whose zero rows stand for fixed parameters; false when
// another pivot is nothing beside its parameter's own information.
bool InvertScaled(Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd own = matrix.diagonal();
  const Eigen::VectorXd scale =
      own.unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.0; });
  Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  for (Eigen::Index i = 0; i < own.size(); ++i)
    if (!(own(i) > 0)) scaled(i, i) = 1;
  const Eigen::LLT<Eigen::MatrixXd> solver(scaled);
  const double smallest = solver.matrixLLT().diagonal().cwiseAbs().minCoeff();
  if (solver.info() != Eigen::Success || !(smallest * smallest > kSingularShare)) return false;
  matrix = scale.asDiagonal() * solver.solve(Eigen::MatrixXd::Identity(own.size(), own.size())) *
           scale.asDiagonal();
  return true;
}

// The Schur complement, group by group.
Status Eliminate(const CalibrationData& data, const BundleBlocks& blocks, BundleSystem& system) {
  system.own = system.global.diagonal();
  for (std::size_t g = 0; g < system.groups.size(); ++g) {
    GroupSystem& group = system.groups[g];
    if (!InvertScaled(group.block))
      return EstimationFailed("the pose of the target in " +
                              data.images[blocks.groups[g].images.front()].image +
                              " is not determined by the corners that were found in it: its "
                              "information matrix is singular; leave the image out");
    const Eigen::MatrixXd solved = group.block.lazyProduct(group.coupling);
    system.global -= group.coupling.transpose().lazyProduct(solved);
    group.coupling = solved;
  }
  return {};
}

}  // namespace

Result<BundleSystem> EliminatePoses(const CalibrationData& data, const ArrayState& state,
                                    const BundleOptions& options, double sigma0,
                                    BundleBlocks& blocks) {
  // Every corner at full weight: what a robust loss does to it stands in sigma0.
  BundleOptions least_squares = options;
  least_squares.robust_sigmas = 0;
  const std::vector<BundleTerm> terms = MakeTerms(data, state, least_squares, blocks);
  const std::vector<GlobalBlock> globals = blocks.Globals(data, state);
  BundleSystem system;
  const Places places = PlaceParameters(globals, blocks, system);
  const double of_corners = 1 / std::max(1.0, sigma0 * sigma0);
  Linearisation linear;
  for (const BundleTerm& term : terms)
    AddTerm(term, places, term.kind == BundleTerm::kCorners ? of_corners : 1, linear, system);
  system.named_from_solver = NamedFromSolver(globals, system.global.rows());
  TELESTRAIN_RETURN_IF_ERROR(Eliminate(data, blocks, system));
  return system;
}

}  // namespace telestrain
