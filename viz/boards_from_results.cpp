#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/rotation.h"
#include "viz/results_parts.h"

namespace telestrain::viz {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// The frame and the order of a pose's covariance: a small rotation about the array's axes, in front
// of rotation_array_from_target, and a shift of origin_in_array_mm.
constexpr std::array kPoseParameters{"rotation_x_rad", "rotation_y_rad", "rotation_z_rad",
                                     "origin_x_mm",    "origin_y_mm",    "origin_z_mm"};

// Why a view did not use a board, by image and view.
using Rejections = std::map<std::pair<std::string, std::string>, std::string>;

// Entries that only took some corners out are left out.
Rejections RejectionsOf(const JsonNode& list) {
  Rejections rejections;
  for (int i = 0; i < list.Size(); ++i) {
    const JsonNode node = list.At(i);
    if (!node.At("whole_board").Flag()) continue;
    rejections[{node.At("image").Text(), node.At("view").Text()}] = node.At("reason").Text();
  }
  return rejections;
}

Matrix6d CovarianceOf(const JsonNode& rows) {
  Matrix6d covariance;
  for (int i = 0; i < 6; ++i) {
    const JsonNode row = rows.At(i);
    if (rows.Size() != 6 || row.Size() != 6) rows.Fail("6 rows of 6 numbers are wanted");
    for (int k = 0; k < 6; ++k) covariance(i, k) = row.At(k).Number();
  }
  return covariance;
}

void CheckPoseParameters(const JsonNode& names) {
  for (std::size_t i = 0; i < kPoseParameters.size(); ++i) {
    const JsonNode name = names.At(static_cast<int>(i));
    if (name.Text() != kPoseParameters[i])
      name.Fail(std::string("'") + kPoseParameters[i] + "' is wanted");
  }
}

// The target in one image.
struct PlacedTarget {
  std::string image, pose;
  double stage_mm = 0;
  Eigen::Matrix3d array_from_target;
  Eigen::Vector3d origin_in_array_mm;
  std::optional<Matrix6d> covariance;
  std::map<std::string, BoardView> used;  // by view

  Eigen::Vector3d InArray(const Eigen::Vector3d& in_target_mm) const {
    return array_from_target * in_target_mm + origin_in_array_mm;
  }
  // The point moves by w x (R X) + d when the pose errs by the rotation w and the shift d.
  Eigen::Matrix3d CovarianceAt(const Eigen::Vector3d& in_target_mm) const {
    if (!covariance) return Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 3, 6> by_pose;
    by_pose << -Skew(array_from_target * in_target_mm), Eigen::Matrix3d::Identity();
    return by_pose * *covariance * by_pose.transpose();
  }
};

std::map<std::string, BoardView> UsedViewsOf(const JsonNode& list, const Scene& scene) {
  std::map<std::string, BoardView> used;
  for (int i = 0; i < list.Size(); ++i) {
    const JsonNode node = list.At(i);
    const std::string view = node.At("view").Text();
    if (std::none_of(scene.views.begin(), scene.views.end(),
                     [&](const ViewVolume& known) { return known.name == view; }))
      node.At("view").Fail("the name of one of the views is wanted");
    used[view] = {view, node.At("corners").Count(), node.At("rms_px").Number()};
  }
  return used;
}

PlacedTarget PlacedTargetOf(const JsonNode& node, const Scene& scene) {
  PlacedTarget placed;
  placed.image = node.At("image").Text();
  placed.pose = node.At("pose").Text();
  placed.stage_mm = node.At("stage_mm").Number();
  placed.array_from_target = node.At("rotation_array_from_target").Rotation();
  placed.origin_in_array_mm = node.At("origin_in_array_mm").Vector3();
  if (node.Has("covariance")) placed.covariance = CovarianceOf(node.At("covariance"));
  placed.used = UsedViewsOf(node.At("boards"), scene);
  return placed;
}

// Rectangle about the board's middle, counter-clockwise in the target frame.
std::array<Eigen::Vector3d, 4> Rectangle(const PlacedTarget& placed, const SubBoard& print,
                                         const Eigen::Vector2d& half_mm) {
  const Eigen::AngleAxisd turn(print.rotation_rad, Eigen::Vector3d::UnitZ());
  const auto corner = [&](double x, double y) {
    return placed.InArray(print.center_in_target_mm +
                          turn * Eigen::Vector3d(x * half_mm.x(), y * half_mm.y(), 0));
  };
  return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

void AddGeometry(const PlacedTarget& placed, const TargetSpec& target, const SubBoard& print,
                 Board* board) {
  board->square_mm = target.square_mm;
  const Eigen::Vector2d half_mm(0.5 * target.square_mm * (target.columns - 1),
                                0.5 * target.square_mm * (target.rows - 1));
  const Eigen::Vector2d margin_mm = Eigen::Vector2d::Constant(target.square_mm);
  board->corner_grid_in_array_mm = Rectangle(placed, print, half_mm);
  board->outline_in_array_mm = Rectangle(placed, print, half_mm + margin_mm);
  const Eigen::Matrix3Xd corners_mm = target.CornersInTarget(print);
  for (Eigen::Index i = 0; i < corners_mm.cols(); ++i)
    board->corners_in_array_mm.push_back(placed.InArray(corners_mm.col(i)));
  board->cov_center_in_array_mm2 = placed.CovarianceAt(print.center_in_target_mm);
}

// What every view of the board's group did with it.
void AddUse(const PlacedTarget& placed, const Rejections& rejections, const Scene& scene,
            Board* board) {
  double sum_px2 = 0;
  int corners = 0;
  for (const ViewVolume& view : scene.views) {
    if (view.group != board->group) continue;
    if (const auto used = placed.used.find(view.name); used != placed.used.end()) {
      board->views.push_back(used->second);
      sum_px2 += used->second.corners * std::pow(used->second.rms_px, 2);
      corners += used->second.corners;
      continue;
    }
    const auto rejected = rejections.find({placed.image, view.name});
    // A table of corners that were found elsewhere need not name every board.
    board->rejected.push_back(
        view.name + ": " +
        (rejected == rejections.end() ? "no corners were given for it" : rejected->second));
  }
  if (corners > 0) board->rms_px = std::sqrt(sum_px2 / corners);
}

}  // namespace

void AddBoards(const JsonNode& calibration, const TargetSpec& target, Scene* scene) {
  const Rejections rejections = RejectionsOf(calibration.At("rejected"));
  const std::vector<std::string> groups = scene->Groups();
  const JsonNode poses = calibration.At("poses");
  for (int i = 0; i < poses.Size(); ++i) {
    const PlacedTarget placed = PlacedTargetOf(poses.At(i), *scene);
    if (placed.covariance) CheckPoseParameters(calibration.At("pose_covariance_parameters"));
    for (const SubBoard& print : target.boards) {
      if (std::find(groups.begin(), groups.end(), print.group) == groups.end()) continue;
      Board board;
      board.image = placed.image;
      board.pose = placed.pose;
      board.group = print.group;
      board.stage_mm = placed.stage_mm;
      AddGeometry(placed, target, print, &board);
      AddUse(placed, rejections, *scene, &board);
      scene->boards.push_back(std::move(board));
    }
  }
  scene->target_poses = poses.Size();
  scene->rejected_board_views = static_cast<int>(rejections.size());
}

}  // namespace telestrain::viz
