#include "calibration/bundle_adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/bundle_covariance.h"
#include "calibration/bundle_terms.h"

namespace telestrain {
namespace {

void HoldFixed(ceres::Problem& problem, double* block, const std::vector<bool>& free) {
  std::vector<int> fixed;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (!free[i]) fixed.push_back(static_cast<int>(i));
  if (fixed.empty() || !problem.HasParameterBlock(block)) return;
  if (fixed.size() == free.size())
    problem.SetParameterBlockConstant(block);
  else
    problem.SetManifold(block, new ceres::SubsetManifold(static_cast<int>(free.size()), fixed));
}

void BuildProblem(const std::vector<BundleTerm>& terms, const std::vector<GlobalBlock>& globals,
                  BundleBlocks& blocks, ceres::Problem& problem) {
  for (const BundleTerm& term : terms)
    problem.AddResidualBlock(term.residual.get(), nullptr, term.blocks);
  for (const GlobalBlock& block : globals) {
    std::vector<bool> adjusted;
    for (std::size_t i = 0; i < block.free.size(); ++i) adjusted.push_back(IsAdjusted(block, i));
    HoldFixed(problem, block.values, adjusted);
  }
  const PosePlace& gauge = blocks.place_of_image[blocks.gauge_pose];
  PoseGroup& group = blocks.groups[gauge.group];
  std::vector<bool> free(group.Size(), true);
  std::fill_n(free.begin() + kPoseSize * gauge.slot, kPoseSize, false);
  HoldFixed(problem, group.values, free);
}

// The poses are eliminated first, each by itself.
std::shared_ptr<ceres::ParameterBlockOrdering> PosesFirst(const std::vector<GlobalBlock>& globals,
                                                          const BundleBlocks& blocks,
                                                          const ceres::Problem& problem) {
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  const auto add = [&](const double* block, int group) {
    if (problem.HasParameterBlock(block))
      ordering->AddElementToGroup(const_cast<double*>(block), group);
  };
  for (const PoseGroup& group : blocks.groups) add(group.values, 0);
  for (const GlobalBlock& global : globals) add(global.values, 1);
  return ordering;
}

ceres::Solver::Options SolverOptions(const BundleOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  // Not LAPACK, whose results differ between machines: the same bytes everywhere.
  solver.dense_linear_algebra_library_type = ceres::EIGEN;
  solver.max_num_iterations = options.max_iterations;
  solver.initial_trust_region_radius = 1e8;  // the seed is close: start with Gauss-Newton steps
  solver.max_trust_region_radius = 1e18;
  solver.function_tolerance = 1e-13;
  solver.parameter_tolerance = 1e-12;
  solver.gradient_tolerance = 1e-16;
  solver.num_threads = 1;  // sums in a fixed order: the same bytes for any thread count
  solver.logging_type = ceres::SILENT;
  return solver;
}

double LossOf(const BundleTerm& term) {
  std::vector<double> residuals(static_cast<std::size_t>(term.residual->num_residuals()));
  if (!term.residual->Evaluate(term.blocks.data(), residuals.data(), nullptr))
    return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const double residual : residuals) sum += residual * residual;
  return sum;
}

void Count(const CalibrationData& data, const std::vector<BundleTerm>& terms,
           const std::vector<GlobalBlock>& globals, const BundleBlocks& blocks,
           BundleResult& result) {
  result.residual_count = static_cast<int>(2 * data.CornerCount());
  for (const BundleTerm& term : terms) {
    const double loss = LossOf(term);
    if (term.kind == BundleTerm::kCorners) result.chi2 += loss;
    if (term.kind == BundleTerm::kPrior) {
      result.chi2_of_priors += loss;
      result.prior_count += term.residual->num_residuals();
    }
    if (term.kind == BundleTerm::kStage) {
      result.chi2_of_stage += loss;
      result.stage_count += term.residual->num_residuals();
    }
  }
  result.parameter_count = kPoseSize * static_cast<int>(blocks.place_of_image.size() - 1);
  for (const GlobalBlock& block : globals)
    if (block.kind == GlobalBlock::kLens || block.kind == GlobalBlock::kView)
      result.parameter_count +=
          static_cast<int>(std::count(block.free.begin(), block.free.end(), true));
}

// Square sum and mean slope of w r, for a loss with w = 1 / (1 + |r|^2 / c^2): the slope, averaged
// over the directions of r, is w^2.
void CountInfluence(const CalibrationData& data, double robust_sigmas, BundleResult& result) {
  result.squared_influence = result.chi2;
  if (robust_sigmas == 0) return;
  double squares = 0, slopes = 0;
  for (const BoardData& board : data.boards) {
    const Eigen::Matrix2Xd errors = ReprojectionErrors_px(result.state, board);
    for (Eigen::Index i = 0; i < errors.cols(); ++i) {
      const double length2 =
          (board.whitening[static_cast<std::size_t>(i)] * errors.col(i)).squaredNorm();
      const double weight = RobustWeight(length2, robust_sigmas);
      squares += weight * weight * length2;
      slopes += weight * weight;
    }
  }
  result.squared_influence = squares;
  result.mean_slope = slopes / static_cast<double>(data.CornerCount());
}

}  // namespace

ArrayState StateFromSeed(const Session& session, const ArraySeed& seed) {
  ArrayState state;
  state.array.lenses = {seed.lens};
  state.array.views = seed.views;
  state.poses = seed.poses;
  state.stage_axis_in_array = session.stage_axis_in_array;
  return state;
}

double BundleResult::Sigma0() const {
  return std::sqrt(squared_influence / std::max(1, residual_count - parameter_count)) / mean_slope;
}

Result<BundleResult> AdjustBundle(const CalibrationData& data, const ArrayState& start,
                                  const BundleOptions& options) {
  BundleBlocks blocks(data, start, options);
  const std::vector<BundleTerm> terms = MakeTerms(data, start, options, blocks);
  const std::vector<GlobalBlock> globals = blocks.Globals(data, start);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.disable_all_safety_checks = true;
  ceres::Problem problem(ownership);
  BuildProblem(terms, globals, blocks, problem);
  ceres::Solver::Options solver = SolverOptions(options);
  solver.linear_solver_ordering = PosesFirst(globals, blocks, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);

  BundleResult result;
  result.gauge_pose = static_cast<int>(blocks.gauge_pose);
  result.state = blocks.State(start, options.model);
  Count(data, terms, globals, blocks, result);
  CountInfluence(data, options.robust_sigmas, result);
  result.iterations = static_cast<int>(summary.iterations.size());
  result.termination = summary.message;
  const bool has_ended =
      summary.termination_type == ceres::CONVERGENCE ||
      (!options.must_converge && summary.termination_type == ceres::NO_CONVERGENCE);
  if (!has_ended || !std::isfinite(result.TotalChi2()))
    return EstimationFailed("the bundle adjustment did not converge after " +
                            std::to_string(result.iterations) + " iterations: " + summary.message);
  if (options.want_covariance) {
    TELESTRAIN_ASSIGN_OR_RETURN(result.covariance,
                                CovarianceOf(data, result.state, options, result.Sigma0()));
    result.state.array.covariance = result.covariance.array;
    result.state.array.covariance_of_noise = result.covariance.array_of_noise;
  }
  return result;
}

Eigen::Matrix2Xd ReprojectionErrors_px(const ArrayState& state, const BoardData& board) {
  const TargetPose& pose = state.poses[static_cast<std::size_t>(board.image)];
  const auto view = static_cast<std::size_t>(board.view);
  const TelecentricLens& lens = state.array.LensOf(view);
  const Eigen::Matrix3Xd corners =
      CornersOfBoard(board.geometry, board.corners_in_board_mm, state.target);
  Eigen::Matrix2Xd errors(2, board.Count());
  for (Eigen::Index i = 0; i < board.Count(); ++i) {
    const Eigen::Vector3d in_array =
        pose.array_from_target * corners.col(i) + pose.origin_in_array_mm;
    errors.col(i) = board.pixels.col(i) - Project(lens, state.array.views[view], in_array);
  }
  return errors;
}

}  // namespace telestrain
