#include "diagnostics/independent_optimum.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "diagnostics/mrcal_telecentric.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

using Residuals = std::vector<Eigen::Matrix2Xd>;

// A board of six by six corners has more. With less the lattice would need too many nodes.
constexpr double kLeastSpread_squares = 1.6;

double SecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Predicted minus measured, as mrcal has them.
Residuals OurResiduals(const CalibrationData& data, const ArrayState& state) {
  Residuals residuals;
  for (const BoardData& board : data.boards)
    residuals.push_back(-ReprojectionErrors_px(state, board));
  return residuals;
}

double MaxDifference(const Residuals& a, const Residuals& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).cwiseAbs().maxCoeff());
  return largest;
}

double Rms(const Residuals& residuals) {
  double squares = 0;
  Eigen::Index count = 0;
  for (const Eigen::Matrix2Xd& of_board : residuals) {
    squares += of_board.squaredNorm();
    count += of_board.size();
  }
  return std::sqrt(squares / static_cast<double>(std::max<Eigen::Index>(1, count)));
}

double MaxMagnificationDifference(const ArrayCalibration& a, const ArrayCalibration& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.views.size(); ++v)
    largest = std::max(
        largest,
        std::abs(a.LensOf(v).magnification_px_per_mm / b.LensOf(v).magnification_px_per_mm - 1));
  return largest;
}

Eigen::Matrix3d FromFirstView(const ArrayCalibration& array, std::size_t view) {
  return array.views[view].Rotation() * array.views.front().Rotation().transpose();
}

double MaxRotationDifference_rad(const ArrayCalibration& a, const ArrayCalibration& b) {
  double largest = 0;
  for (std::size_t v = 1; v < a.views.size(); ++v)
    largest = std::max(largest, AngleBetween_rad(FromFirstView(a, v), FromFirstView(b, v)));
  return largest;
}

// Keeps the images of `kept` with their boards and poses.
void KeepImages(const std::set<int>& kept, CommonProblem& common) {
  std::map<int, int> new_index;
  CalibrationData& data = common.data;
  std::vector<CalibrationImage> images;
  std::vector<TargetPose> poses;
  for (const int image : kept) {
    new_index[image] = static_cast<int>(images.size());
    images.push_back(data.images[static_cast<std::size_t>(image)]);
    poses.push_back(common.start.poses[static_cast<std::size_t>(image)]);
  }
  std::erase_if(data.boards, [&](const BoardData& board) { return !kept.contains(board.image); });
  for (BoardData& board : data.boards) board.image = new_index.at(board.image);
  data.images = std::move(images);
  common.start.poses = std::move(poses);
}

}  // namespace

bool IndependentOptimum::agrees() const {
  return max_residual_difference_px <= kMaxResidualDifference_px &&
         evaluated_max_residual_difference_px <= kMaxResidualDifference_px;
}

CommonProblem CommonProblemOf(const CalibrationData& data, const ArrayState& start) {
  CommonProblem common{data, start};
  std::set<int> kept, narrow;
  for (BoardData& board : common.data.boards) {
    kept.insert(board.image);
    if (LeastSpread_mm(board) < kLeastSpread_squares * data.target.square_mm)
      narrow.insert(board.image);
    for (Eigen::Matrix2d& whitening : board.whitening)
      whitening = IsotropicWeight(whitening) * Eigen::Matrix2d::Identity();
  }
  for (const int image : narrow) kept.erase(image);
  common.images_left_out = static_cast<int>(narrow.size());
  KeepImages(kept, common);
  for (CalibrationImage& image : common.data.images) {
    image.pose = image.image;
    image.stage_mm = 0;
  }
  TargetSpec& target = common.data.target;
  target.sigma_square_um = target.sigma_separation_um = 0;
  target.coplanarity_um = target.flatness_um = 0;
  common.start.target = {};
  for (TelecentricLens& lens : common.start.array.lenses)
    lens = {lens.magnification_px_per_mm, lens.center_px};
  return common;
}

Result<IndependentOptimum> CompareOptima(const CommonProblem& common, const ArrayState& ours) {
  IndependentOptimum found;
  found.images = static_cast<int>(common.data.images.size());
  found.images_left_out = common.images_left_out;
  const auto begin = std::chrono::steady_clock::now();
  TELESTRAIN_ASSIGN_OR_RETURN(LatticeProblem lattice, LatticeProblemOf(common.data, common.start));
  TELESTRAIN_ASSIGN_OR_RETURN(const MrcalOutcome outcome, SolveWithMrcal(lattice.problem));
  found.mrcal_seconds = SecondsSince(begin);
  found.mrcal_converged = outcome.converged;
  const ArrayState theirs = StateOfMrcal(lattice, common.start);
  TELESTRAIN_ASSIGN_OR_RETURN(const Residuals of_mrcal,
                              MrcalCornerResiduals(common.data, theirs, lattice.problem.cameras));
  const Residuals of_ours = OurResiduals(common.data, ours);
  found.max_residual_difference_px = MaxDifference(of_ours, of_mrcal);
  found.max_magnification_difference = MaxMagnificationDifference(ours.array, theirs.array);
  found.max_rotation_difference_rad = MaxRotationDifference_rad(ours.array, theirs.array);
  found.rms_px = Rms(of_ours);
  found.mrcal_rms_px = Rms(of_mrcal);
  return found;
}

Result<IndependentOptimum> CheckAgainstMrcal(const CalibrationData& data,
                                             const ArrayState& solution, const ArrayState& start) {
  const CommonProblem common = CommonProblemOf(data, start);
  if (common.data.images.empty())
    return EstimationFailed("no image shows enough of every board for mrcal's lattice");
  const auto begin = std::chrono::steady_clock::now();
  BundleOptions options;
  options.model.per_view = true;
  TELESTRAIN_ASSIGN_OR_RETURN(const BundleResult ours,
                              AdjustBundle(common.data, common.start, options));
  const double seconds = SecondsSince(begin);
  TELESTRAIN_ASSIGN_OR_RETURN(IndependentOptimum found, CompareOptima(common, ours.state));
  found.seconds = seconds;
  found.iterations = ours.iterations;
  ArrayState parallel = solution;
  for (TelecentricLens& lens : parallel.array.lenses) {
    found.telecentricity_left_out_per_mm =
        std::max(found.telecentricity_left_out_per_mm, std::abs(lens.telecentricity_per_mm));
    lens.telecentricity_per_mm = 0;
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const Residuals evaluated,
                              MrcalCornerResiduals(data, parallel, MrcalCamerasOf(parallel.array)));
  found.evaluated_max_residual_difference_px =
      MaxDifference(OurResiduals(data, parallel), evaluated);
  return found;
}

}  // namespace telestrain
