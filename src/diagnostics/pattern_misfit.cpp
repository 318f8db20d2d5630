#include "diagnostics/pattern_misfit.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "diagnostics/noise_distributions.h"
#include "diagnostics/pattern_columns.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kParallelViews = 0.02;  // sine of the angle between two directions
constexpr int kMostSteps = 20;
constexpr double kSmallStep = 1e-10;  // rad, mm
// The other boards fit unless noise is less likely to leave as much; small, as the array has its
// own uncertainty.
constexpr double kFits = 1e-6;

// The pose of one image with the array as it is, by Gauss and Newton.
struct PoseFit {
  ArrayState state;  // with this pose alone
  double squares = 0;
  int scalars = 0;
};
PoseFit FitPose(const std::vector<BoardData>& boards, const ArrayState& array,
                const TargetPose& start) {
  PoseFit fit{array};
  fit.state.poses = {start};
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    fit.squares = 0;
    fit.scalars = 0;
    for (const BoardData& board : boards) {
      const Eigen::MatrixXd columns = PatternColumns(board, fit.state);
      const auto by_pose = columns.middleCols<6>(PatternLayout::kPoseAt);
      const auto residual = columns.col(PatternLayout::kResidualAt);
      normal += by_pose.transpose() * by_pose;
      right += by_pose.transpose() * residual;
      fit.squares += residual.squaredNorm();
      fit.scalars += static_cast<int>(residual.size());
    }
    const Eigen::Matrix<double, 6, 1> change =
        normal.completeOrthogonalDecomposition().solve(right);
    if (change.norm() < kSmallStep) break;
    TargetPose& pose = fit.state.poses.front();
    pose.array_from_target = ExpRotation(change.head<3>()) * pose.array_from_target;
    pose.origin_in_array_mm += change.tail<3>();
  }
  return fit;
}

bool Fits(const PoseFit& fit, double sigma0) {
  const int degrees = fit.scalars - 6;
  return degrees > 0 && ChiSquareUpperTail(fit.squares / (sigma0 * sigma0), degrees) > kFits;
}

}  // namespace

bool ViewsDeterminePose(const std::vector<BoardData>& boards, const ArrayCalibration& array) {
  const auto direction = [&](const BoardData& board) {
    return array.views[static_cast<std::size_t>(board.view)].RayDirection();
  };
  for (const BoardData& board : boards)
    if (direction(board).cross(direction(boards.front())).norm() > kParallelViews) return true;
  return false;
}

ImageMisfit ExamineImage(const std::vector<BoardData>& boards, const TargetSpec& target,
                         const ArrayState& array, const TargetPose& start, double sigma0) {
  ImageMisfit misfit;
  double best = 0;
  for (std::size_t left_out = 0; left_out < boards.size(); ++left_out) {
    std::vector<BoardData> others;
    for (std::size_t b = 0; b < boards.size(); ++b) {
      if (b == left_out) continue;
      others.push_back(boards[b]);
      others.back().image = 0;
    }
    if (!ViewsDeterminePose(others, array.array)) continue;
    const PoseFit fit = FitPose(others, array, start);
    if (!Fits(fit, sigma0) || (misfit.culprit >= 0 && fit.squares >= best)) continue;
    best = fit.squares;
    misfit.culprit = static_cast<int>(left_out);
    misfit.pose = fit.state.poses.front();
    BoardData culprit = boards[left_out];
    culprit.image = 0;
    misfit.labels = ReadLabels(culprit, target, fit.state);
  }
  return misfit;
}

}  // namespace telestrain
