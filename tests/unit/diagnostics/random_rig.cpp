#include "unit/diagnostics/random_rig.h"

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/rotation.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain::testing_support {
namespace {

constexpr double kPi = 3.141592653589793;

Eigen::Vector3d Normal3(Random& random, double sigma) {
  const double x = random.Normal(sigma), y = random.Normal(sigma);
  return {x, y, random.Normal(sigma)};
}

NominalView MakeView(const std::string& group, int index, double azimuth_rad, Random& random) {
  const double from_normal_rad = random.Uniform(0.3, 0.7) * (index == 0 ? 1 : -1);
  const Eigen::AngleAxisd tilt(from_normal_rad,
                               Eigen::Vector3d(std::cos(azimuth_rad), std::sin(azimuth_rad), 0));
  const Eigen::AngleAxisd roll(random.Uniform(-kPi, kPi), Eigen::Vector3d::UnitZ());
  const Eigen::Matrix3d axes = (tilt * roll).toRotationMatrix();
  NominalView view;
  view.group = group;
  view.name = group + std::to_string(index + 1);
  view.image_x_in_array = axes.col(0);
  view.image_y_in_array = axes.col(1) * (random.Uniform(0, 1) < 0.5 ? -1 : 1);
  view.axis_in_array = -axes.col(2);
  return view;
}

Session MakeSession(int images, Random& random) {
  Session session;
  session.sensor = {2592, 1944, 2.2};
  session.lens_magnification = random.Uniform(0.2, 0.6);
  session.target.columns = static_cast<int>(random.Uniform(8, 14));
  session.target.rows = static_cast<int>(random.Uniform(7, 10));
  session.target.square_mm = random.Uniform(0.25, 0.5);
  const int groups = random.Uniform(0, 1) < 0.5 ? 2 : 3;
  const double height_mm = random.Uniform(-1, 1);
  for (int g = 0; g < groups; ++g) {
    const std::string name(1, static_cast<char>('A' + g));
    const double direction = random.Uniform(-0.4, 0.4) + 2 * kPi * g / groups;
    const double reach_mm = random.Uniform(6, 12), azimuth_rad = random.Uniform(-kPi, kPi);
    const Eigen::Vector3d center(reach_mm * std::cos(direction), reach_mm * std::sin(direction),
                                 height_mm);
    session.target.boards.push_back({name, center, random.Uniform(-kPi, kPi)});
    for (const int index : {0, 1})
      session.views.push_back(MakeView(name, index, azimuth_rad, random));
  }
  for (int k = 0; k < images; ++k) {
    const std::string name = "image_" + std::to_string(k);
    session.calibration_images.push_back({name, name, 0.0});
  }
  return session;
}

ArrayState MakeTruth(const Session& session, Random& random) {
  ArrayState truth;
  TelecentricLens lens = session.NominalLens();
  lens.magnification_px_per_mm *= 1 + random.Normal(1e-3);
  lens.aspect = 1 + random.Normal(1e-4);
  lens.distortion = {random.Normal(1e-6), random.Normal(1e-9), random.Normal(1e-6),
                     random.Normal(1e-6), random.Normal(1e-12)};
  truth.array.lenses = {lens};
  for (const NominalView& nominal : session.views) {
    TelecentricView view = session.NominalTelecentricView(nominal);
    view.axes_in_array = (ExpRotation(Normal3(random, 0.01)) * view.Rotation()).topRows<2>();
    view.offset_mm += Normal3(random, 0.1).head<2>();
    truth.array.views.push_back(view);
  }
  for (std::size_t k = 0; k < session.calibration_images.size(); ++k)
    truth.poses.push_back({ExpRotation(Normal3(random, 0.07)), Normal3(random, 0.5)});
  for (std::size_t b = 0; b < session.target.boards.size(); ++b) {
    BoardShape shape;
    shape.bow_x_mm = random.Normal(1e-3);
    shape.bow_y_mm = random.Normal(1e-3);
    truth.target.boards.push_back(shape);
  }
  return truth;
}

Eigen::Matrix2d RandomCovariance(Random& random) {
  const Eigen::Matrix2d axes = Eigen::Rotation2Dd(random.Uniform(-kPi, kPi)).toRotationMatrix();
  const double major_px = random.Uniform(0.05, 0.2), minor_px = random.Uniform(0.02, 0.05);
  const Eigen::Matrix2d variances =
      Eigen::Vector2d(major_px * major_px, minor_px * minor_px).asDiagonal();
  return axes * variances * axes.transpose();
}

// One board in five is cut off by an edge, one in five has holes.
std::vector<bool> SeenCorners(const TargetSpec& target, Random& random) {
  const double kind = random.Uniform(0, 1);
  const int first_column = kind < 0.2 ? static_cast<int>(random.Uniform(1, 4)) : 0;
  const double hole_share = kind > 0.8 ? random.Uniform(0.1, 0.5) : 0;
  std::vector<bool> seen;
  for (int i = 0; i < target.CornerCount(); ++i)
    seen.push_back(i % target.columns >= first_column && random.Uniform(0, 1) >= hole_share);
  return seen;
}

std::vector<BoardObservation> Observe(const Session& session, const ArrayState& truth,
                                      Random& random) {
  std::vector<BoardObservation> observations;
  for (std::size_t k = 0; k < truth.poses.size(); ++k) {
    for (std::size_t v = 0; v < session.views.size(); ++v) {
      if (random.Uniform(0, 1) < 0.1) continue;
      const std::vector<bool> seen = SeenCorners(session.target, random);
      BoardObservation observation{session.calibration_images[k].image, session.views[v].name,
                                   std::vector<std::optional<ImagePoint>>(seen.size()), ""};
      for (std::size_t i = 0; i < seen.size(); ++i)
        if (seen[i])
          observation.corners[i] = ImagePoint{Eigen::Vector2d::Zero(), RandomCovariance(random)};
      observations.push_back(std::move(observation));
    }
  }
  return observations;
}

void Disturb(ArrayState& state, Random& random) {
  for (TelecentricView& view : state.array.views) {
    view.axes_in_array = (ExpRotation(Normal3(random, 1e-3)) * view.Rotation()).topRows<2>();
    view.offset_mm += Normal3(random, 0.005).head<2>();
  }
  for (TargetPose& pose : state.poses) pose.origin_in_array_mm += Normal3(random, 0.005);
}

}  // namespace

RandomRig MakeRandomRig(std::uint64_t seed, int images) {
  Random random(seed);
  const Session session = MakeSession(images, random);
  RandomRig rig;
  rig.truth = MakeTruth(session, random);
  rig.data = CollectCalibrationData(session, Observe(session, rig.truth, random)).value();
  // Poses of the images that two directions see.
  ArrayState kept = rig.truth;
  kept.poses.clear();
  for (const CalibrationImage& image : rig.data.images)
    for (std::size_t k = 0; k < rig.truth.poses.size(); ++k)
      if (session.calibration_images[k].image == image.image)
        kept.poses.push_back(rig.truth.poses[k]);
  rig.truth = kept;
  for (BoardData& board : rig.data.boards) {
    board.pixels = -ReprojectionErrors_px(rig.truth, board);
    for (Eigen::Index i = 0; i < board.Count(); ++i)
      board.pixels.col(i) += board.whitening[static_cast<std::size_t>(i)].inverse() *
                             Eigen::Vector2d(random.Normal(1), random.Normal(1));
  }
  rig.start = rig.truth;
  rig.start.target = {};
  rig.start.array.lenses = {session.NominalLens()};
  Disturb(rig.start, random);
  return rig;
}

}  // namespace telestrain::testing_support
