#include "calibration/cross_validation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr std::size_t kLeastPoses = 6;
constexpr int kPoseParameters = 6;
constexpr int kPoseIterations = 8, kRobustIterations = 30;  // reweighting converges linearly

// The fold of every image: images of one pose stay together.
std::vector<int> FoldOfImages(const CalibrationData& data, int folds) {
  std::map<std::string, int> number_of_pose;
  std::vector<int> fold;
  for (const CalibrationImage& image : data.images) {
    const int next = static_cast<int>(number_of_pose.size());
    fold.push_back(number_of_pose.try_emplace(image.pose, next).first->second % folds);
  }
  return fold;
}

std::size_t PoseCount(const CalibrationData& data) {
  std::map<std::string, int> poses;
  for (const CalibrationImage& image : data.images) ++poses[image.pose];
  return poses.size();
}

// Data and state of the images for which keep(image) holds.
template <typename Keep>
std::pair<CalibrationData, ArrayState> Part(const CalibrationData& data, const ArrayState& state,
                                            const Keep& keep) {
  std::pair<CalibrationData, ArrayState> part{data, state};
  part.first.images.clear();
  part.first.boards.clear();
  part.second.poses.clear();
  std::vector<int> new_index(data.images.size(), -1);
  for (std::size_t k = 0; k < data.images.size(); ++k) {
    if (!keep(k)) continue;
    new_index[k] = static_cast<int>(part.first.images.size());
    part.first.images.push_back(data.images[k]);
    part.second.poses.push_back(state.poses[k]);
  }
  for (const BoardData& board : data.boards) {
    const int image = new_index[static_cast<std::size_t>(board.image)];
    if (image < 0) continue;
    part.first.boards.push_back(board);
    part.first.boards.back().image = image;
  }
  return part;
}

bool SeesEveryView(const CalibrationData& data, std::size_t views) {
  std::vector<int> boards(views, 0);
  for (const BoardData& board : data.boards) ++boards[static_cast<std::size_t>(board.view)];
  return *std::min_element(boards.begin(), boards.end()) >= 2;
}

// Square sums over the corners of left-out images, their poses fitted.
struct Misfit {
  double whitened = 0, pixels2 = 0, variance_px2 = 0;
  int scalars = 0, poses = 0;

  Misfit& operator+=(const Misfit& other) {
    whitened += other.whitened, pixels2 += other.pixels2, variance_px2 += other.variance_px2;
    scalars += other.scalars, poses += other.poses;
    return *this;
  }
  int Freedom() const { return scalars - kPoseParameters * poses; }
  double NormalisedRms() const { return std::sqrt(whitened / Freedom()); }
};

// How the corners of left-out images count: as in the adjustment.
struct CornerWeights {
  double floor_px = 0;
  double robust_sigmas = 0;  // corners of less than half the weight are no part of the misfit
};

// The normal equations of one pose: left rotation perturbation and origin.
struct PoseEquations {
  Eigen::Matrix<double, kPoseParameters, kPoseParameters> normal =
      Eigen::Matrix<double, kPoseParameters, kPoseParameters>::Zero();
  Eigen::Matrix<double, kPoseParameters, 1> right =
      Eigen::Matrix<double, kPoseParameters, 1>::Zero();
};

void AddBoard(const BoardData& board, const ArrayState& state, const CornerWeights& weights,
              PoseEquations& equations, Misfit& misfit) {
  const auto view = static_cast<std::size_t>(board.view);
  const TargetPose& pose = state.poses[static_cast<std::size_t>(board.image)];
  const Eigen::Matrix3Xd corners =
      CornersOfBoard(board.geometry, board.corners_in_board_mm, state.target);
  const Eigen::Matrix2Xd errors = ReprojectionErrors_px(state, board);
  for (Eigen::Index i = 0; i < board.Count(); ++i) {
    const Eigen::Matrix2d& w = board.whitening[static_cast<std::size_t>(i)];
    const Eigen::Vector3d turned = pose.array_from_target * corners.col(i);
    const Eigen::Matrix<double, 2, 3> by_point =
        w * ProjectJacobian(state.array.LensOf(view), state.array.views[view],
                            turned + pose.origin_in_array_mm);
    Eigen::Matrix<double, 2, kPoseParameters> jacobian;
    jacobian << -by_point * Skew(turned), by_point;
    const Eigen::Vector2d error = w * errors.col(i);
    const double weight = RobustWeight(error.squaredNorm(), weights.robust_sigmas);
    equations.normal += weight * jacobian.transpose() * jacobian;
    equations.right += weight * jacobian.transpose() * error;
    if (weight < 0.5) continue;
    misfit.whitened += error.squaredNorm();
    misfit.pixels2 += errors.col(i).squaredNorm();
    misfit.variance_px2 +=
        (w.transpose() * w).inverse().trace() - 2 * weights.floor_px * weights.floor_px;
    misfit.scalars += 2;
  }
}

// Gauss-Newton for the pose of one image, the array held fixed.
Misfit FitPose(const CalibrationData& data, const CornerWeights& weights, std::size_t image,
               ArrayState& state) {
  const int iterations = weights.robust_sigmas > 0 ? kRobustIterations : kPoseIterations;
  for (int iteration = 0;; ++iteration) {
    PoseEquations equations;
    Misfit misfit;
    misfit.poses = 1;
    for (const BoardData& board : data.boards)
      if (board.image == static_cast<int>(image))
        AddBoard(board, state, weights, equations, misfit);
    if (iteration == iterations) return misfit;
    const Eigen::Matrix<double, kPoseParameters, 1> step =
        equations.normal.ldlt().solve(equations.right);
    TargetPose& pose = state.poses[image];
    pose.array_from_target = ExpRotation(step.head<3>()) * pose.array_from_target;
    pose.origin_in_array_mm += step.tail<3>();
  }
}

// Predicts the images of one fold with `predicting` and notes the worst of them.
Misfit PredictFold(const CalibrationData& data, const CornerWeights& weights,
                   const std::function<bool(std::size_t)>& is_left_out, ArrayState predicting,
                   CrossValidation& validation) {
  Misfit sum;
  for (std::size_t k = 0; k < data.images.size(); ++k) {
    if (!is_left_out(k)) continue;
    const Misfit misfit = FitPose(data, weights, k, predicting);
    if (misfit.Freedom() > 0 && misfit.NormalisedRms() > validation.worst_normalised_rms) {
      validation.worst_normalised_rms = misfit.NormalisedRms();
      validation.worst_image = data.images[k].image;
    }
    sum += misfit;
  }
  return sum;
}

}  // namespace

Result<CrossValidation> CrossValidate(const CalibrationData& data, const ArrayState& solution,
                                      const BundleOptions& options, int folds) {
  CrossValidation validation;
  const std::size_t poses = PoseCount(data);
  if (poses < kLeastPoses) return validation;
  folds = std::min(folds, static_cast<int>(poses));
  const std::vector<int> fold_of = FoldOfImages(data, folds);
  Misfit all;
  for (int fold = 0; fold < folds; ++fold) {
    const auto [rest, start] =
        Part(data, solution, [&](std::size_t k) { return fold_of[k] != fold; });
    ++validation.folds;
    ++validation.folds_skipped;
    if (!SeesEveryView(rest, solution.array.views.size())) continue;
    const auto solved = AdjustBundle(rest, start, options);
    if (!solved) continue;  // too little is left; the fit itself does not depend on it
    --validation.folds_skipped;
    const double ratio =
        solved->state.array.Magnification_px_per_mm() / solution.array.Magnification_px_per_mm();
    validation.magnification_change_ppm =
        std::max(validation.magnification_change_ppm, 1e6 * std::abs(ratio - 1));
    ArrayState predicting = solution;
    predicting.array = solved->state.array;
    predicting.target = solved->state.target;
    all += PredictFold(
        data, {data.floor_px, options.robust_sigmas},
        [&](std::size_t k) { return fold_of[k] == fold; }, std::move(predicting), validation);
  }
  if (all.Freedom() <= 0) return validation;
  validation.rms_px = std::sqrt(all.pixels2 / all.scalars);
  validation.expected_rms_px =
      std::sqrt(std::max(0.0, all.variance_px2) / all.scalars * all.Freedom() / all.scalars);
  validation.normalised_rms = all.NormalisedRms();
  return validation;
}

}  // namespace telestrain
