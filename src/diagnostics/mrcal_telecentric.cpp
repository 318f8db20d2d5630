#include "diagnostics/mrcal_telecentric.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/check.h"

namespace telestrain {
namespace {

MrcalCamera CameraAt(const TelecentricLens& lens, const TelecentricView& view) {
  constexpr std::array<int, 5> kPower{2, 4, 1, 1, 6};  // of mm in k1, k2, p1, p2, k3
  MrcalCamera camera;
  camera.focal_px = kMrcalDistance_mm * lens.Scales_px_per_mm();
  camera.principal_px = lens.center_px;
  for (std::size_t i = 0; i < kPower.size(); ++i)
    camera.distortion[i] = lens.distortion[i] * std::pow(kMrcalDistance_mm, kPower[i]);
  camera.camera_from_reference = view.Rotation();
  camera.origin_in_camera_mm = {view.offset_mm.x(), view.offset_mm.y(), kMrcalDistance_mm};
  return camera;
}

MrcalSighting SightingOf(const BoardData& board, int nodes) {
  MrcalSighting sighting{board.view, board.image, Eigen::Matrix2Xd::Zero(2, nodes),
                         Eigen::VectorXd::Zero(nodes)};
  for (Eigen::Index i = 0; i < board.Count(); ++i) {
    const int node = board.corner[static_cast<std::size_t>(i)];
    sighting.pixels.col(node) = board.pixels.col(i);
    sighting.weight_1_px(node) = 1;
  }
  return sighting;
}

// The sub-board's own grid with its pitch and bows, in the poses of the plate.
MrcalProblem ProblemOfBoard(const CalibrationData& data, const ArrayState& state, int sub_board) {
  const BoardShape shape = state.target.Board(sub_board);
  TELESTRAIN_CHECK(
      shape.shift_mm == 0 && shape.height_mm == 0 && shape.tilt_x_rad == 0 && shape.tilt_y_rad == 0,
      "boards lie where their certificate says");
  const double scale = 1 + state.target.pitch_relative;
  const TargetPose grid = GridInTarget(GeometryOfBoard(data.target, sub_board), scale);
  MrcalProblem problem;
  problem.columns = data.target.columns;
  problem.rows = data.target.rows;
  problem.spacing_mm = scale * data.target.square_mm;
  problem.bow_x_mm = shape.bow_x_mm;
  problem.bow_y_mm = shape.bow_y_mm;
  problem.unit_mm = kMrcalUnit_mm;
  for (const TargetPose& pose : state.poses) problem.frames.push_back(Compose(pose, grid));
  return problem;
}

}  // namespace

std::vector<MrcalCamera> MrcalCamerasOf(const ArrayCalibration& array) {
  std::vector<MrcalCamera> cameras;
  for (std::size_t v = 0; v < array.views.size(); ++v)
    cameras.push_back(CameraAt(array.LensOf(v), array.views[v]));
  return cameras;
}

Result<std::vector<Eigen::Matrix2Xd>> MrcalCornerResiduals(
    const CalibrationData& data, const ArrayState& state, const std::vector<MrcalCamera>& cameras) {
  std::vector<Eigen::Matrix2Xd> residuals(data.boards.size());
  for (int b = 0; b < static_cast<int>(data.target.boards.size()); ++b) {
    MrcalProblem problem = ProblemOfBoard(data, state, b);
    problem.cameras = cameras;
    std::vector<std::size_t> seen;
    for (std::size_t i = 0; i < data.boards.size(); ++i) {
      if (data.boards[i].geometry.board != b) continue;
      problem.sightings.push_back(SightingOf(data.boards[i], data.target.CornerCount()));
      seen.push_back(i);
    }
    if (seen.empty()) continue;
    TELESTRAIN_ASSIGN_OR_RETURN(const auto of_grids, MrcalResiduals(problem));
    for (std::size_t s = 0; s < seen.size(); ++s)
      residuals[seen[s]] = of_grids[s](Eigen::all, data.boards[seen[s]].corner);
  }
  return residuals;
}

Result<LatticeProblem> LatticeProblemOf(const CalibrationData& data, const ArrayState& start) {
  constexpr double kSamePlane_mm = 1e-9;
  constexpr int kMaxNodes = 4000;  // some 10 s of mrcal for 36 images
  LatticeProblem made;
  made.lattice = LatticeOver(data);
  if (made.lattice.NodeCount() > kMaxNodes)
    return EstimationFailed("the plate is too large for its boards: mrcal's lattice would have " +
                            std::to_string(made.lattice.NodeCount()) + " nodes, " +
                            std::to_string(kMaxNodes) + " at most");
  made.problem.columns = made.lattice.columns;
  made.problem.rows = made.lattice.rows;
  made.problem.spacing_mm = made.lattice.spacing_mm;
  made.problem.unit_mm = kMrcalUnit_mm;
  ArrayCalibration undistorted = start.array;
  for (TelecentricLens& lens : undistorted.lenses)
    lens = {lens.magnification_px_per_mm, lens.center_px};
  made.problem.cameras = MrcalCamerasOf(undistorted);
  made.problem.pins = PinsAt(made.problem.cameras);
  TargetPose first_node;
  first_node.origin_in_array_mm = made.lattice.first_node_in_target_mm;
  for (const TargetPose& pose : start.poses)
    made.problem.frames.push_back(Compose(pose, first_node));
  for (const BoardData& board : data.boards) {
    const Eigen::VectorXd heights_mm =
        board.corners_in_target_mm.row(2).array() - made.lattice.first_node_in_target_mm.z();
    if (heights_mm.cwiseAbs().maxCoeff() > kSamePlane_mm)
      return EstimationFailed("mrcal's target is one plane; these sub-boards lie in several");
    auto condensed = Condense(board, made.lattice);
    if (!condensed)
      return EstimationFailed("a board has too few corners for mrcal's lattice of " +
                              std::to_string(made.lattice.spacing_mm) + " mm");
    made.problem.sightings.push_back(
        {board.view, board.image, std::move(condensed->pixels), std::move(condensed->weight_1_px)});
  }
  return made;
}

ArrayState StateOfMrcal(const LatticeProblem& solved, const ArrayState& start) {
  ArrayState state = start;
  state.target = {};
  state.array.lenses.clear();
  state.array.model = LensModel{.per_view = true};
  for (std::size_t v = 0; v < state.array.views.size(); ++v) {
    const MrcalCamera& camera = solved.problem.cameras[v];
    state.array.lenses.push_back(
        {camera.focal_px.x() / camera.origin_in_camera_mm.z(), camera.principal_px});
    state.array.views[v].axes_in_array = camera.camera_from_reference.topRows<2>();
    state.array.views[v].offset_mm = camera.origin_in_camera_mm.head<2>();
  }
  for (std::size_t k = 0; k < state.poses.size(); ++k) {
    const TargetPose& frame = solved.problem.frames[k];
    state.poses[k].array_from_target = frame.array_from_target;
    state.poses[k].origin_in_array_mm =
        frame.origin_in_array_mm - frame.array_from_target * solved.lattice.first_node_in_target_mm;
  }
  return state;
}

}  // namespace telestrain
