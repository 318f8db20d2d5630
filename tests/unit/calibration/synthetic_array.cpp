#include "unit/calibration/synthetic_array.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/check.h"
#include "geometry/rotation.h"

namespace telestrain::testing_support {
namespace {

constexpr double kRadPerDeg = 0.017453292519943295;

NominalView MakeView(const std::string& name, const std::string& group, int group_sign,
                     int view_sign, bool mirrored) {
  NominalView view;
  view.name = name;
  view.group = group;
  view.region = {group_sign < 0 ? 0 : 1296, view_sign < 0 ? 0 : 972, 1296, 972};
  const double half = std::sqrt(3.0) / 2;
  view.image_x_in_array = {1, 0, 0};
  view.image_y_in_array = Eigen::Vector3d(0, half, -0.5 * view_sign) * (mirrored ? -1 : 1);
  view.axis_in_array = {0, -0.5 * view_sign, -half};
  view.center_in_array_mm = {13.85 * group_sign, 0, 0};
  return view;
}

Session MakeSession(const SyntheticOptions& options) {
  Session session;
  session.title = "synthetic";
  session.sensor = {2592, 1944, 2.2};
  session.lens_magnification = 0.5;
  session.depth_of_field_mm = 3.1;
  for (const int g : {-1, 1})
    for (const int v : {-1, 1})
      session.views.push_back(MakeView(std::string(g < 0 ? "A" : "B") + (v < 0 ? "1" : "2"),
                                       g < 0 ? "A" : "B", g, v, options.mirrored));
  session.target.columns = 13;
  session.target.rows = 9;
  session.target.square_mm = 0.3;
  session.target.boards = {{"A", {-13.85, 0, 0}, 0}, {"B", {13.85, 0, 0}, 0}};
  session.ruler.length_mm = 27.6;
  session.pipe.outer_diameter_mm = 8;
  for (int pose = 0; pose < options.poses; ++pose)
    for (int move = 0; move < 2; ++move)
      session.calibration_images.push_back(
          {"board_" + std::to_string(pose) + (move ? "b" : "a") + ".png", std::to_string(pose),
           static_cast<double>(move)});
  return session;
}

}  // namespace

double Random::Uniform(double from, double to) {
  state_ += 0x9E3779B97F4A7C15ull;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  z ^= z >> 31;
  return from + (to - from) * (static_cast<double>(z >> 11) + 0.5) * 0x1.0p-53;
}

double Random::Normal(double sigma) {
  const double radius = std::sqrt(-2 * std::log(Uniform(0, 1)));
  return sigma * radius * std::cos(2 * 3.14159265358979323846 * Uniform(0, 1));
}

Calibration MustCalibrate(const SyntheticArray& array) {
  return Calibrate(array.session, array.boards).value();
}

ImagePoint Observe(const SyntheticArray& array, std::size_t view, const Eigen::Vector3d& point,
                   double noise_px, Random& random) {
  ImagePoint observed;
  const TelecentricLens& lens = array.lens_of_view.empty() ? array.lens : array.lens_of_view[view];
  observed.pixel = Project(lens, array.views[view], point);
  observed.pixel.x() += random.Normal(noise_px);
  observed.pixel.y() += random.Normal(noise_px);
  observed.covariance_px2 = std::max(noise_px * noise_px, 1e-8) * Eigen::Matrix2d::Identity();
  return observed;
}

SyntheticArray MakeSyntheticArray(const SyntheticOptions& options) {
  SyntheticArray array;
  Random random(options.seed);
  array.session = MakeSession(options);
  array.lens = array.session.NominalLens();
  array.lens.magnification_px_per_mm *= 1.002;
  array.lens.distortion[0] = options.k1_per_mm2;
  for (const NominalView& nominal : array.session.views) {
    TelecentricView view = array.session.NominalTelecentricView(nominal);
    const double e = options.view_error_deg * kRadPerDeg;
    const Eigen::Vector3d turn(random.Uniform(-e, e), random.Uniform(-e, e), random.Uniform(-e, e));
    view.axes_in_array = (ExpRotation(turn) * view.Rotation()).topRows<2>();
    view.offset_mm += Eigen::Vector2d(random.Uniform(-0.1, 0.1), random.Uniform(-0.1, 0.1));
    array.views.push_back(view);
  }
  const double tilt = options.max_tilt_deg * kRadPerDeg;
  TargetPose pose;
  for (const CalibrationImage& image : array.session.calibration_images) {
    if (image.stage_mm == 0) {
      pose.array_from_target =
          ExpRotation({random.Uniform(-tilt, tilt), random.Uniform(-tilt / 8, tilt / 8),
                       random.Uniform(-0.02, 0.02)});
      pose.origin_in_array_mm = {random.Uniform(-0.5, 0.5), random.Uniform(-0.4, 0.4),
                                 random.Uniform(-1.0, 0.0)};
    }
    TargetPose moved = pose;
    moved.origin_in_array_mm += options.stage_sense * image.stage_mm * Eigen::Vector3d::UnitZ();
    array.poses.push_back(moved);
    for (std::size_t v = 0; v < array.views.size(); ++v) {
      const auto* board = array.session.target.FindBoard(array.views[v].group);
      const Eigen::Matrix3Xd corners = array.session.target.CornersInTarget(*board);
      BoardObservation observation{image.image, array.views[v].name, {}, {}};
      for (Eigen::Index i = 0; i < corners.cols(); ++i)
        observation.corners.push_back(
            Observe(array, v, moved.array_from_target * corners.col(i) + moved.origin_in_array_mm,
                    options.noise_px, random));
      array.boards.push_back(std::move(observation));
    }
  }
  return array;
}

void ObserveAgain(SyntheticArray& array, double noise_px, std::uint64_t seed) {
  Random random(seed);
  auto data = CollectCalibrationData(array.session, array.boards);
  TELESTRAIN_CHECK(data.ok() && data->boards.size() == array.boards.size(), "whole boards only");
  for (std::size_t b = 0; b < array.boards.size(); ++b) {
    const BoardData& board = data->boards[b];
    const TargetPose& pose = array.poses[static_cast<std::size_t>(board.image)];
    const Eigen::Matrix3Xd corners =
        CornersOfBoard(board.geometry, board.corners_in_board_mm, array.shape);
    for (Eigen::Index i = 0; i < corners.cols(); ++i)
      array.boards[b].corners[static_cast<std::size_t>(i)] = Observe(
          array, static_cast<std::size_t>(board.view),
          pose.array_from_target * corners.col(i) + pose.origin_in_array_mm, noise_px, random);
  }
}

}  // namespace telestrain::testing_support
