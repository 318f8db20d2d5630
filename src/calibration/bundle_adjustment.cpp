#include "calibration/bundle_adjustment.h"

#include <ceres/ceres.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <map>

#include "calibration/board_residual.h"

namespace telestrain {
namespace {

// The numbers that Ceres moves.
struct Blocks {
  double unit_px_per_mm = 1;  // what a relative magnification of 1 means
  Eigen::Vector2d center_px;
  std::array<double, kLensSize> lens{};
  std::vector<std::array<double, kViewSize>> views;
  std::vector<std::array<double, kPoseSize>> poses;
  Eigen::Vector3d stage_axis;  // the two tilts are small about it
  std::array<double, 2> stage_tilt{};
};

Blocks MakeBlocks(const ArrayState& start) {
  Blocks blocks;
  blocks.unit_px_per_mm = start.array.lens.magnification_px_per_mm;
  blocks.center_px = start.array.lens.center_px;
  blocks.lens[0] = 1;
  for (std::size_t i = 0; i < 5; ++i)
    blocks.lens[i + 1] =
        start.array.lens.distortion[i] * std::pow(kScaleRadius_mm, kRadiusPower[i]);
  for (const TelecentricView& view : start.array.views) {
    const Eigen::Vector3d w = LogRotation(view.Rotation());
    blocks.views.push_back({w.x(), w.y(), w.z(), view.offset_mm.x(), view.offset_mm.y()});
  }
  for (const TargetPose& pose : start.poses) {
    const Eigen::Vector3d w = LogRotation(pose.array_from_target);
    const Eigen::Vector3d& t = pose.origin_in_array_mm;
    blocks.poses.push_back({w.x(), w.y(), w.z(), t.x(), t.y(), t.z()});
  }
  blocks.stage_axis = start.stage_axis_in_array.normalized();
  return blocks;
}

// Two unit vectors that complete `axis` to an orthonormal triple.
std::pair<Eigen::Vector3d, Eigen::Vector3d> Sides(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d side_x = axis.unitOrthogonal();
  return {side_x, axis.cross(side_x)};
}

ArrayState StateFromBlocks(const ArrayState& start, const Blocks& blocks) {
  ArrayState state = start;
  state.array.lens = LensFromBlock(blocks.lens.data(), blocks.unit_px_per_mm, blocks.center_px);
  for (std::size_t i = 0; i < blocks.views.size(); ++i) {
    const auto& view = blocks.views[i];
    state.array.views[i].axes_in_array = ExpRotation({view[0], view[1], view[2]}).topRows<2>();
    state.array.views[i].offset_mm = {view[3], view[4]};
  }
  for (std::size_t k = 0; k < blocks.poses.size(); ++k) {
    const auto& pose = blocks.poses[k];
    state.poses[k].array_from_target = ExpRotation({pose[0], pose[1], pose[2]});
    state.poses[k].origin_in_array_mm = {pose[3], pose[4], pose[5]};
  }
  const auto [side_x, side_y] = Sides(blocks.stage_axis);
  state.stage_axis_in_array =
      (blocks.stage_axis + side_x * blocks.stage_tilt[0] + side_y * blocks.stage_tilt[1])
          .normalized();
  return state;
}

int MostSeenPose(const CalibrationData& data) {
  std::vector<int> seen(data.images.size(), 0);
  for (const BoardData& board : data.boards) ++seen[static_cast<std::size_t>(board.image)];
  return static_cast<int>(std::max_element(seen.begin(), seen.end()) - seen.begin());
}

void AddStageResiduals(const CalibrationData& data, double sigma_mm, Blocks& blocks,
                       ceres::Problem& problem) {
  const auto [side_x, side_y] = Sides(blocks.stage_axis);
  std::map<std::string, std::size_t> first_of_pose;
  for (std::size_t k = 0; k < data.images.size(); ++k) {
    const auto [at, is_first] = first_of_pose.try_emplace(data.images[k].pose, k);
    const double travel_mm = data.images[k].stage_mm - data.images[at->second].stage_mm;
    if (is_first || travel_mm == 0) continue;
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<StageResidual, 3, kPoseSize, kPoseSize, 2>(
            new StageResidual{blocks.stage_axis, side_x, side_y, travel_mm, sigma_mm}),
        nullptr, blocks.poses[at->second].data(), blocks.poses[k].data(), blocks.stage_tilt.data());
  }
}

void BuildProblem(const CalibrationData& data, const BundleOptions& options, int gauge_pose,
                  Blocks& blocks, ceres::Problem& problem) {
  for (const BoardData& board : data.boards)
    problem.AddResidualBlock(new BoardResidual(board, blocks.unit_px_per_mm, blocks.center_px),
                             nullptr, blocks.lens.data(),
                             blocks.views[static_cast<std::size_t>(board.view)].data(),
                             blocks.poses[static_cast<std::size_t>(board.image)].data());
  AddStageResiduals(data, options.stage_sigma_mm, blocks, problem);
  problem.SetParameterBlockConstant(blocks.poses[static_cast<std::size_t>(gauge_pose)].data());
  std::vector<int> fixed;
  for (int i = 0; i < 5; ++i)
    if (!options.model[static_cast<std::size_t>(i)]) fixed.push_back(i + 1);
  if (!fixed.empty())
    problem.SetManifold(blocks.lens.data(), new ceres::SubsetManifold(kLensSize, fixed));
}

// Lens and views first, then everything else that is free.
Eigen::SparseMatrix<double> NormalMatrix(ceres::Problem& problem, Blocks& blocks) {
  ceres::Problem::EvaluateOptions options;
  options.num_threads = 1;
  options.parameter_blocks = {blocks.lens.data()};
  for (auto& view : blocks.views) options.parameter_blocks.push_back(view.data());
  for (auto& pose : blocks.poses)
    if (!problem.IsParameterBlockConstant(pose.data()))
      options.parameter_blocks.push_back(pose.data());
  if (problem.HasParameterBlock(blocks.stage_tilt.data()))
    options.parameter_blocks.push_back(blocks.stage_tilt.data());
  ceres::CRSMatrix crs;
  problem.Evaluate(options, nullptr, nullptr, nullptr, &crs);
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> jacobian(
      crs.num_rows, crs.num_cols, static_cast<Eigen::Index>(crs.values.size()), crs.rows.data(),
      crs.cols.data(), crs.values.data());
  const Eigen::SparseMatrix<double> columns = jacobian;
  return columns.transpose() * columns;
}

// From the solver's parameters to those of ArrayCalibration::covariance: units of the lens, and
// left perturbations instead of rotation vectors.
Eigen::MatrixXd ParameterScale(const Blocks& blocks, const DistortionModel& model) {
  std::vector<double> lens{blocks.unit_px_per_mm};
  for (std::size_t i = 0; i < 5; ++i)
    if (model[i]) lens.push_back(1.0 / std::pow(kScaleRadius_mm, kRadiusPower[i]));
  const auto lens_size = static_cast<Eigen::Index>(lens.size());
  const Eigen::Index size = lens_size + kViewSize * static_cast<Eigen::Index>(blocks.views.size());
  Eigen::MatrixXd scale = Eigen::MatrixXd::Identity(size, size);
  for (Eigen::Index i = 0; i < lens_size; ++i) scale(i, i) = lens[static_cast<std::size_t>(i)];
  Eigen::Index at = lens_size;
  for (const auto& view : blocks.views) {
    scale.block<3, 3>(at, at) = LeftJacobian({view[0], view[1], view[2]});
    at += kViewSize;
  }
  return scale;
}

Result<Eigen::MatrixXd> CovarianceOfArray(ceres::Problem& problem, Blocks& blocks,
                                          const DistortionModel& model) {
  const Eigen::SparseMatrix<double> normal = NormalMatrix(problem, blocks);
  const Eigen::MatrixXd scale = ParameterScale(blocks, model);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
  const Eigen::VectorXd pivots = solver.vectorD();
  if (solver.info() != Eigen::Success || !(pivots.minCoeff() > 1e-14 * pivots.maxCoeff()))
    return EstimationFailed(
        "the images do not determine the calibration: the information matrix is singular; add "
        "poses with different tilts and positions in every view");
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(normal.rows(), scale.rows());
  const Eigen::MatrixXd solved = solver.solve(unit);
  const Eigen::MatrixXd covariance = scale * solved.topRows(scale.rows()) * scale.transpose();
  return Eigen::MatrixXd(0.5 * (covariance + covariance.transpose()));
}

ceres::Solver::Options SolverOptions(const BundleOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  // Not CHOLMOD, whose BLAS differs between machines: the same bytes everywhere.
  solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 1e-14;
  solver.parameter_tolerance = 1e-12;
  solver.gradient_tolerance = 1e-16;
  solver.num_threads = 1;  // sums in a fixed order: the same bytes for any thread count
  solver.logging_type = ceres::SILENT;
  return solver;
}

}  // namespace

Result<BundleResult> AdjustBundle(const CalibrationData& data, const ArrayState& start,
                                  const BundleOptions& options) {
  BundleResult result;
  result.gauge_pose = MostSeenPose(data);
  Blocks blocks = MakeBlocks(start);
  ceres::Problem problem;
  BuildProblem(data, options, result.gauge_pose, blocks, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options), &problem, &summary);

  result.state = StateFromBlocks(start, blocks);
  result.state.array.model = options.model;
  result.chi2 = 2 * summary.final_cost;
  result.residual_count = problem.NumResiduals();
  result.parameter_count = summary.num_effective_parameters_reduced;
  result.iterations = static_cast<int>(summary.iterations.size());
  result.termination = summary.message;
  if (summary.termination_type != ceres::CONVERGENCE)
    return EstimationFailed("the bundle adjustment did not converge after " +
                            std::to_string(result.iterations) + " iterations: " + summary.message);
  if (options.want_covariance) {
    TELESTRAIN_ASSIGN_OR_RETURN(result.state.array.covariance,
                                CovarianceOfArray(problem, blocks, options.model));
  }
  return result;
}

Eigen::Matrix2Xd ReprojectionErrors_px(const ArrayState& state, const BoardData& board) {
  const TargetPose& pose = state.poses[static_cast<std::size_t>(board.image)];
  const TelecentricView& view = state.array.views[static_cast<std::size_t>(board.view)];
  Eigen::Matrix2Xd errors(2, board.Count());
  for (Eigen::Index i = 0; i < board.Count(); ++i) {
    const Eigen::Vector3d in_array =
        pose.array_from_target * board.corners_in_target_mm.col(i) + pose.origin_in_array_mm;
    errors.col(i) = board.pixels.col(i) - Project(state.array.lens, view, in_array);
  }
  return errors;
}

}  // namespace telestrain
