#include "diagnostics/pattern_system.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "diagnostics/noise_distributions.h"

namespace telestrain {
namespace {

using Layout = PatternLayout;

// Of a direction's squared length, that part which must be left after the eliminations: below it
// is rounding (1e-16 times the condition of the poses).
constexpr double kInvisible = 1e-9;
constexpr double kSingular = 1e-11;  // among the parameters of the calibration
// Of the whitened residuals: below this variance they are rounding and not noise.
constexpr double kSmallestVariance = 1e-6;

// Pseudo-inverse of a positive semidefinite matrix whose elements are scaled by `diagonal`;
// directions below `tolerance` count as zero.
struct PseudoInverse {
  Eigen::MatrixXd inverse;
  int rank = 0;
};
PseudoInverse Invert(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& diagonal,
                     double tolerance) {
  PseudoInverse result;
  result.inverse = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
  if (matrix.rows() == 0) return result;
  const Eigen::VectorXd scale =
      diagonal.unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.0; });
  const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (!(solver.eigenvalues()[i] > tolerance)) continue;
    const Eigen::VectorXd direction = scale.asDiagonal() * solver.eigenvectors().col(i);
    result.inverse += direction * direction.transpose() / solver.eigenvalues()[i];
    ++result.rank;
  }
  return result;
}

}  // namespace

int PatternSystem::GlobalColumn(const BoardData& board, int local) const {
  if (local < Layout::kViewSize) return ViewColumn(board.view, local);
  if (local < Layout::kPoseAt) return BoardColumn(board.geometry.board, local - Layout::kBoardAt);
  return size_;
}

PatternSystem::PatternSystem(const CalibrationData& data, const ArrayState& state)
    : data_(data), views_(static_cast<int>(state.array.views.size())) {
  size_ =
      views_ * Layout::kViewSize + static_cast<int>(data.target.boards.size()) * Layout::kBoardSize;
  images_ = static_cast<int>(data.images.size());
  gram_ = Eigen::MatrixXd::Zero(size_ + 1, size_ + 1);
  std::vector<Eigen::Matrix<double, 6, 6>> pose_grams(
      data.images.size(), Eigen::Matrix<double, 6, 6>(Eigen::Matrix<double, 6, 6>::Zero()));
  poses_.resize(data.images.size());
  for (PoseBlock& pose : poses_) pose.coupling = Eigen::MatrixXd::Zero(6, size_ + 1);
  for (const BoardData& board : data.boards) {
    const Eigen::MatrixXd columns = PatternColumns(board, state);
    grams_.emplace_back(LocalGram(columns.transpose() * columns));
    const LocalGram& local = grams_.back();
    scalars_ += static_cast<int>(columns.rows());
    const auto image = static_cast<std::size_t>(board.image);
    pose_grams[image] += local.block<6, 6>(Layout::kPoseAt, Layout::kPoseAt);
    for (int i = 0; i < Layout::kColumns; ++i) {
      if (i >= Layout::kPoseAt && i < Layout::kResidualAt) continue;
      const int global = GlobalColumn(board, i);
      poses_[image].coupling.col(global) += local.block<6, 1>(Layout::kPoseAt, i);
      for (int j = 0; j < Layout::kColumns; ++j)
        if (j < Layout::kPoseAt || j == Layout::kResidualAt)
          gram_(global, GlobalColumn(board, j)) += local(i, j);
    }
  }
  diagonal_ = gram_.diagonal().head(size_);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    poses_[i].inverse = Invert(pose_grams[i], pose_grams[i].diagonal(), kSingular).inverse;
    gram_ -= poses_[i].coupling.transpose() * poses_[i].inverse * poses_[i].coupling;
  }
  taken_out_.resize(size_, 0);
  TakeOut(taken_out_);
}

void PatternSystem::TakeOut(const Eigen::MatrixXd& combinations) {
  Eigen::MatrixXd all(size_, taken_out_.cols() + combinations.cols());
  all << taken_out_, combinations;
  taken_out_ = all;
  const Eigen::MatrixXd half = gram_.leftCols(size_) * taken_out_;
  const Eigen::VectorXd full =
      (taken_out_.array().square().matrix().transpose() * diagonal_).eval();
  const PseudoInverse inverse =
      Invert(taken_out_.transpose() * half.topRows(size_), full, kSingular);
  taken_out_inverse_ = inverse.inverse;
  rank_ = inverse.rank;
  projected_ = gram_ - half * taken_out_inverse_ * half.transpose();
  squares_ = std::max(0.0, projected_(size_, size_));
}

PatternFit PatternSystem::Solve(const Eigen::MatrixXd& normal, const Eigen::VectorXd& right,
                                const Eigen::VectorXd& full_diagonal) const {
  PatternFit fit;
  const PseudoInverse inverse = Invert(normal, full_diagonal, kInvisible);
  fit.rank = inverse.rank;
  fit.values = inverse.inverse * right;
  fit.sigmas = inverse.inverse.diagonal().cwiseMax(0).cwiseSqrt();
  if (fit.rank == 0 || Degrees() <= fit.rank) return fit;
  fit.explained = std::clamp(right.dot(fit.values), 0.0, squares_);
  const double degrees = Degrees() - fit.rank;
  const double variance = std::max((squares_ - fit.explained) / degrees, kSmallestVariance);
  fit.sigmas *= std::sqrt(variance);
  fit.f_statistic = fit.explained / fit.rank / variance;
  fit.p_value = FUpperTail(fit.f_statistic, fit.rank, degrees);
  const double n = scalars_;
  fit.schwarz_gain = n * std::log1p(fit.explained / (variance * degrees)) - fit.rank * std::log(n);
  return fit;
}

PatternFit PatternSystem::Fit(const Eigen::MatrixXd& combinations) const {
  const Eigen::MatrixXd half = projected_.leftCols(size_) * combinations;
  const Eigen::VectorXd full = combinations.array().square().matrix().transpose() * diagonal_;
  return Solve(combinations.transpose() * half.topRows(size_), half.row(size_).transpose(), full);
}

PatternFit PatternSystem::FitBoards(const std::vector<std::size_t>& boards) const {
  constexpr int kBlock = Layout::kAffineSize;
  const int count = kBlock * static_cast<int>(boards.size());
  const PoseBlock& pose = poses_[static_cast<std::size_t>(data_.boards[boards.front()].image)];
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd by_pose(count, 6);
  Eigen::MatrixXd by_global = Eigen::MatrixXd::Zero(count, size_ + 1);
  for (std::size_t k = 0; k < boards.size(); ++k) {
    const LocalGram& local = grams_[boards[k]];
    const int at = kBlock * static_cast<int>(k);
    const auto affine = local.middleRows<kBlock>(Layout::kAffineAt);
    normal.block<kBlock, kBlock>(at, at) = affine.middleCols<kBlock>(Layout::kAffineAt);
    by_pose.middleRows<kBlock>(at) = affine.middleCols<6>(Layout::kPoseAt);
    for (int i = 0; i < Layout::kColumns; ++i)
      if (i < Layout::kPoseAt || i == Layout::kResidualAt)
        by_global.block<kBlock, 1>(at, GlobalColumn(data_.boards[boards[k]], i)) = affine.col(i);
  }
  const Eigen::VectorXd full = normal.diagonal();
  normal -= by_pose * pose.inverse * by_pose.transpose();
  by_global -= by_pose * pose.inverse * pose.coupling;
  const Eigen::MatrixXd by_taken = by_global.leftCols(size_) * taken_out_;
  const Eigen::VectorXd taken_right = taken_out_.transpose() * gram_.col(size_).head(size_);
  normal -= by_taken * taken_out_inverse_ * by_taken.transpose();
  const Eigen::VectorXd right =
      by_global.col(size_) - by_taken * (taken_out_inverse_ * taken_right);
  return Solve(normal, right, full);
}

}  // namespace telestrain
