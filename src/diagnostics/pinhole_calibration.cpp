#include "diagnostics/pinhole_calibration.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "diagnostics/pinhole_residual.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

// The numbers that Ceres moves.
struct Blocks {
  std::vector<std::array<double, kPinholeLensSize>> lenses;
  std::vector<std::array<double, kPinholeCameraSize>> cameras;
  std::vector<std::array<double, kPinholePoseSize>> poses;
};

Blocks MakeBlocks(const std::vector<PinholeView>& views, const std::vector<TargetPose>& poses) {
  Blocks blocks;
  for (const PinholeView& view : views) {
    blocks.lenses.push_back(PinholeLensBlock(view));
    blocks.cameras.push_back(PinholeCameraBlock(view));
  }
  for (const TargetPose& pose : poses) {
    const Eigen::Vector3d w = LogRotation(pose.array_from_target);
    const Eigen::Vector3d& t = pose.origin_in_array_mm;
    blocks.poses.push_back({w.x(), w.y(), w.z(), t.x(), t.y(), t.z()});
  }
  return blocks;
}

std::size_t MostSeenPose(const CalibrationData& data) {
  std::vector<int> seen(data.images.size(), 0);
  for (const BoardData& board : data.boards) ++seen[static_cast<std::size_t>(board.image)];
  return static_cast<std::size_t>(std::max_element(seen.begin(), seen.end()) - seen.begin());
}

void HoldLens(double* lens, const PinholeOptions& options, ceres::Problem& problem) {
  if (!problem.HasParameterBlock(lens)) return;
  if (options.lock_core && !options.free_distortion) return problem.SetParameterBlockConstant(lens);
  std::vector<int> fixed;
  for (int i = 0; i < kPinholeLensSize; ++i)
    if (i == 0 ? options.lock_core : !options.free_distortion) fixed.push_back(i);
  if (!fixed.empty()) problem.SetManifold(lens, new ceres::SubsetManifold(kPinholeLensSize, fixed));
}

void BuildProblem(const CalibrationData& data, const std::vector<PinholeView>& start,
                  const PinholeOptions& options, Blocks& blocks, ceres::Problem& problem) {
  for (const BoardData& board : data.boards) {
    const auto view = static_cast<std::size_t>(board.view);
    problem.AddResidualBlock(new PinholeBoardResidual(board, start[view]), nullptr,
                             blocks.lenses[view].data(), blocks.cameras[view].data(),
                             blocks.poses[static_cast<std::size_t>(board.image)].data());
  }
  problem.SetParameterBlockConstant(blocks.poses[MostSeenPose(data)].data());
  for (auto& lens : blocks.lenses) HoldLens(lens.data(), options, problem);
}

ceres::Solver::Options SolverOptions(const PinholeOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  // Not CHOLMOD, whose BLAS differs between machines: the same bytes everywhere.
  solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 1e-10;  // the RMS is then right to ten digits
  solver.parameter_tolerance = 1e-12;
  solver.gradient_tolerance = 1e-16;
  solver.num_threads = 1;  // sums in a fixed order: the same bytes for any thread count
  solver.logging_type = ceres::SILENT;
  return solver;
}

// Over scalars and over corners, as ReprojectionStatistics defines them.
ReprojectionStatistics Statistics(const CalibrationData& data,
                                  const std::vector<Eigen::Matrix2Xd>& errors_px, int view) {
  ReprojectionStatistics sums;
  for (std::size_t b = 0; b < errors_px.size(); ++b) {
    if (view >= 0 && data.boards[b].view != view) continue;
    const Eigen::VectorXd norms = errors_px[b].colwise().norm();
    if (norms.size() == 0) continue;
    sums.rms_px += norms.squaredNorm();
    sums.mean_px += norms.sum();
    sums.max_px = std::max(sums.max_px, norms.maxCoeff());
    sums.corners += static_cast<int>(norms.size());
  }
  if (sums.corners == 0) return sums;
  sums.rms_px = std::sqrt(sums.rms_px / (2.0 * sums.corners));
  sums.mean_px /= sums.corners;
  return sums;
}

Result<std::vector<Eigen::Matrix2Xd>> Errors_px(const CalibrationData& data,
                                                const PinholeCalibration& found) {
  std::vector<Eigen::Matrix2Xd> errors;
  for (const BoardData& board : data.boards) {
    const PinholeView& view = found.views[static_cast<std::size_t>(board.view)];
    const TargetPose& pose = found.poses[static_cast<std::size_t>(board.image)];
    Eigen::Matrix2Xd of_board(2, board.Count());
    for (Eigen::Index i = 0; i < board.Count(); ++i) {
      const auto predicted = view.Project(
          pose.array_from_target * board.corners_in_target_mm.col(i) + pose.origin_in_array_mm);
      if (!predicted)
        return EstimationFailed("the pinhole fit puts a corner of view " + view.name +
                                " behind its camera; state a larger working distance");
      of_board.col(i) = board.pixels.col(i) - *predicted;
    }
    errors.push_back(std::move(of_board));
  }
  return errors;
}

PinholeCalibration FromBlocks(const std::vector<PinholeView>& start, const Blocks& blocks) {
  PinholeCalibration found;
  for (std::size_t v = 0; v < start.size(); ++v) {
    found.views.push_back(
        PinholeViewFromBlocks(start[v], blocks.lenses[v].data(), blocks.cameras[v].data()));
    found.focal_length_growth = std::max(found.focal_length_growth, blocks.lenses[v][0]);
  }
  for (const auto& pose : blocks.poses)
    found.poses.push_back({ExpRotation({pose[0], pose[1], pose[2]}), {pose[3], pose[4], pose[5]}});
  return found;
}

// Middle of the corners that a view saw, in the array.
Eigen::Vector3d MiddleOfCorners_mm(const CalibrationData& data, const ArrayState& telecentric,
                                   int view) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int boards = 0;
  for (const BoardData& board : data.boards) {
    if (board.view != view || board.Count() == 0) continue;
    const TargetPose& pose = telecentric.poses[static_cast<std::size_t>(board.image)];
    sum += pose.array_from_target * board.corners_in_target_mm.rowwise().mean() +
           pose.origin_in_array_mm;
    ++boards;
  }
  return boards == 0 ? sum : Eigen::Vector3d(sum / boards);
}

}  // namespace

void CountErrors(const CalibrationData& data, PinholeCalibration& calibration) {
  calibration.all = Statistics(data, calibration.errors_px, -1);
  calibration.of_view.clear();
  for (std::size_t v = 0; v < calibration.views.size(); ++v)
    calibration.of_view.push_back(Statistics(data, calibration.errors_px, static_cast<int>(v)));
}

std::vector<PinholeView> PinholeViewsAt(const Session& session, const CalibrationData& data,
                                        const ArrayState& telecentric,
                                        const PinholeOptions& options) {
  std::vector<PinholeView> views;
  for (std::size_t v = 0; v < telecentric.array.views.size(); ++v) {
    const TelecentricView& source = telecentric.array.views[v];
    const TelecentricLens& lens = telecentric.array.LensOf(v);
    PinholeView view;
    view.name = source.name;
    view.group = source.group;
    view.working_distance_mm = options.working_distance_mm;
    view.scale_px_per_mm = lens.magnification_px_per_mm;
    view.principal_px = options.principal_at_sensor_middle ? session.sensor.Middle()
                                                           : session.views[v].region.Middle();
    view.flipped = source.RayDirection().dot(session.views[v].axis_in_array) < 0;
    const double sign = view.flipped ? -1 : 1;
    const Eigen::Vector3d mirror(sign, 1, sign);  // u reversed, the axis towards the object
    view.camera_from_array = mirror.asDiagonal() * source.Rotation();
    const Eigen::Vector2d offset_mm =
        source.offset_mm -
        (view.principal_px - lens.center_px).cwiseQuotient(lens.Scales_px_per_mm());
    const Eigen::Vector3d middle = MiddleOfCorners_mm(data, telecentric, static_cast<int>(v));
    view.origin_in_camera_mm = {
        sign * offset_mm.x(), offset_mm.y(),
        options.working_distance_mm - view.camera_from_array.row(2).dot(middle)};
    views.push_back(view);
  }
  return views;
}

Result<PinholeCalibration> CalibratePinhole(const Session& session, const CalibrationData& data,
                                            const ArrayState& telecentric,
                                            const PinholeOptions& options) {
  TELESTRAIN_CHECK(options.working_distance_mm > 0, "the working distance is positive");
  TELESTRAIN_CHECK(telecentric.poses.size() == data.images.size(), "one pose an image");
  const std::vector<PinholeView> start = PinholeViewsAt(session, data, telecentric, options);
  Blocks blocks = MakeBlocks(start, telecentric.poses);
  ceres::Problem problem;
  BuildProblem(data, start, options, blocks, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options), &problem, &summary);
  if (summary.termination_type == ceres::FAILURE)
    return EstimationFailed("the pinhole adjustment failed at a working distance of " +
                            std::to_string(options.working_distance_mm) +
                            " mm: " + summary.message);
  PinholeCalibration found = FromBlocks(start, blocks);
  found.iterations = static_cast<int>(summary.iterations.size()) - 1;
  found.hit_iteration_limit = summary.termination_type == ceres::NO_CONVERGENCE;
  found.termination = summary.message;
  TELESTRAIN_ASSIGN_OR_RETURN(found.errors_px, Errors_px(data, found));
  CountErrors(data, found);
  return found;
}

}  // namespace telestrain
