#include "diagnostics/pinhole_mrcal.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <optional>

#include "diagnostics/mrcal_lattice.h"
#include "diagnostics/mrcal_problem.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

MrcalCamera CameraOf(const PinholeView& view) {
  MrcalCamera camera;
  camera.focal_px = Eigen::Vector2d::Constant(view.FocalLength_px());
  camera.principal_px = view.principal_px;
  camera.distortion = view.DistortionOfOpenCv();
  camera.camera_from_reference = view.camera_from_array;
  camera.origin_in_camera_mm = view.origin_in_camera_mm;
  return camera;
}

// One group of views and its sub-board. Cameras and frames of mrcal are views and images in order.
struct Group {
  std::vector<std::size_t> views;   // of each camera
  std::vector<int> images;          // of each frame
  std::vector<std::size_t> boards;  // of each sighting
  TargetPose grid_in_target;
  MrcalProblem problem;
};

// A mirrored view is a camera whose image is reversed about the principal point.
MrcalSighting SightingOf(const BoardData& board, const PinholeView& view, int nodes) {
  MrcalSighting sighting{0, 0, Eigen::Matrix2Xd::Zero(2, nodes), Eigen::VectorXd::Zero(nodes)};
  for (Eigen::Index i = 0; i < board.Count(); ++i) {
    const auto corner = static_cast<std::size_t>(i);
    Eigen::Vector2d pixel = board.pixels.col(i);
    if (view.flipped) pixel.x() = 2 * view.principal_px.x() - pixel.x();
    sighting.pixels.col(board.corner[corner]) = pixel;
    sighting.weight_1_px(board.corner[corner]) = IsotropicWeight(board.whitening[corner]);
  }
  return sighting;
}

Group MakeGroup(const CalibrationData& data, const std::vector<PinholeView>& views,
                const std::vector<TargetPose>& poses, const std::string& name) {
  Group group;
  group.problem.columns = data.target.columns;
  group.problem.rows = data.target.rows;
  group.problem.spacing_mm = data.target.square_mm;
  std::map<std::size_t, int> camera_of_view;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (views[v].group != name) continue;
    camera_of_view[v] = static_cast<int>(group.views.size());
    group.views.push_back(v);
    group.problem.cameras.push_back(CameraOf(views[v]));
  }
  for (std::size_t b = 0; b < data.boards.size(); ++b) {
    const BoardData& board = data.boards[b];
    const auto view = static_cast<std::size_t>(board.view);
    if (!camera_of_view.contains(view)) continue;
    if (group.images.empty() || group.images.back() != board.image) {
      group.images.push_back(board.image);
      group.grid_in_target = GridInTarget(board.geometry);
      group.problem.frames.push_back(
          Compose(poses[static_cast<std::size_t>(board.image)], group.grid_in_target));
    }
    group.boards.push_back(b);
    group.problem.sightings.push_back(SightingOf(board, views[view], data.target.CornerCount()));
    group.problem.sightings.back().camera = camera_of_view.at(view);
    group.problem.sightings.back().frame = static_cast<int>(group.images.size()) - 1;
  }
  return group;
}

TargetPose Inverse(const TargetPose& pose) {
  const Eigen::Matrix3d turned = pose.array_from_target.transpose();
  return {turned, -turned * pose.origin_in_array_mm};
}

// Poses of the plate that the group found, by image.
std::map<int, TargetPose> PosesOf(const Group& group) {
  std::map<int, TargetPose> poses;
  for (std::size_t f = 0; f < group.images.size(); ++f)
    poses[group.images[f]] = Compose(group.problem.frames[f], Inverse(group.grid_in_target));
  return poses;
}

// Array from the group's own frame: brings its poses nearest to those that are known.
std::optional<TargetPose> Place(const std::map<int, TargetPose>& poses,
                                const std::map<int, TargetPose>& known) {
  Eigen::Matrix3d turns = Eigen::Matrix3d::Zero();
  int common = 0;
  for (const auto& [image, pose] : poses) {
    const auto at = known.find(image);
    if (at == known.end()) continue;
    turns += at->second.array_from_target * pose.array_from_target.transpose();
    ++common;
  }
  if (common == 0) return std::nullopt;
  TargetPose place{NearestRotation(turns), Eigen::Vector3d::Zero()};
  Eigen::Vector3d shifts = Eigen::Vector3d::Zero();
  for (const auto& [image, pose] : poses)
    if (const auto at = known.find(image); at != known.end())
      shifts += at->second.origin_in_array_mm - place.array_from_target * pose.origin_in_array_mm;
  place.origin_in_array_mm = shifts / common;
  return place;
}

void TakeViews(const Group& group, const TargetPose& array_from_group, PinholeCalibration& found) {
  for (std::size_t c = 0; c < group.views.size(); ++c) {
    const MrcalCamera& camera = group.problem.cameras[c];
    PinholeView& view = found.views[group.views[c]];
    const TargetPose camera_from_array = Compose(
        {camera.camera_from_reference, camera.origin_in_camera_mm}, Inverse(array_from_group));
    view.camera_from_array = camera_from_array.array_from_target;
    view.origin_in_camera_mm = camera_from_array.origin_in_array_mm;
    view.SetDistortionOfOpenCv(camera.distortion);
  }
}

// mrcal's residuals are weighted and, in a mirrored view, reversed.
Status TakeErrors(const CalibrationData& data, const Group& group, PinholeCalibration& found) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto residuals, MrcalResiduals(group.problem));
  for (std::size_t s = 0; s < group.boards.size(); ++s) {
    const BoardData& board = data.boards[group.boards[s]];
    const MrcalSighting& sighting = group.problem.sightings[s];
    const double u_sign = found.views[static_cast<std::size_t>(board.view)].flipped ? 1 : -1;
    Eigen::Matrix2Xd errors_px(2, board.Count());
    for (Eigen::Index i = 0; i < board.Count(); ++i) {
      const int node = board.corner[static_cast<std::size_t>(i)];
      const Eigen::Vector2d residual_px = residuals[s].col(node) / sighting.weight_1_px(node);
      errors_px.col(i) = Eigen::Vector2d(u_sign * residual_px.x(), -residual_px.y());
    }
    found.errors_px[group.boards[s]] = std::move(errors_px);
  }
  return {};
}

}  // namespace

Result<PinholeCalibration> CalibratePinholeWithMrcal(const Session& session,
                                                     const CalibrationData& data,
                                                     const ArrayState& telecentric,
                                                     const PinholeOptions& options) {
  TELESTRAIN_CHECK(options.lock_core, "mrcal solves the pinhole arm with a locked core");
  PinholeCalibration found;
  found.views = PinholeViewsAt(session, data, telecentric, options);
  found.poses = telecentric.poses;
  found.errors_px.resize(data.boards.size());
  std::map<int, TargetPose> known;
  for (const std::string& name : session.Groups()) {
    Group group = MakeGroup(data, found.views, telecentric.poses, name);
    if (group.boards.empty()) continue;
    group.problem.free_distortion = options.free_distortion;
    if (group.views.size() > 1 && !options.free_distortion)
      group.problem.pins = PinsAt(group.problem.cameras);
    TELESTRAIN_ASSIGN_OR_RETURN(const MrcalOutcome outcome, SolveWithMrcal(group.problem));
    found.iterations += outcome.runs;
    found.hit_iteration_limit = found.hit_iteration_limit || !outcome.converged;
    TELESTRAIN_RETURN_IF_ERROR(TakeErrors(data, group, found));
    const std::map<int, TargetPose> poses = PosesOf(group);
    const auto place = known.empty() ? TargetPose() : Place(poses, known);
    if (!place)
      return EstimationFailed("no image shows the boards of group " + name +
                              " and of an earlier one: nothing ties the groups together");
    TakeViews(group, *place, found);
    for (const auto& [image, pose] : poses) known.try_emplace(image, Compose(*place, pose));
  }
  for (const auto& [image, pose] : known) found.poses[static_cast<std::size_t>(image)] = pose;
  found.termination = found.hit_iteration_limit ? "mrcal still moves" : "mrcal stays";
  CountErrors(data, found);
  return found;
}

}  // namespace telestrain
