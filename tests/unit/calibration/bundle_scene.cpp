#include "unit/calibration/bundle_scene.h"

#include "geometry/rotation.h"

namespace telestrain::testing_support {
namespace {

void ObserveCorners(double noise_px, Random& random, Scene& scene) {
  for (BoardData& board : scene.data.boards) {
    board.pixels.setZero();
    board.pixels = -ReprojectionErrors_px(scene.truth, board);
    for (double& value : board.pixels.reshaped()) value += random.Normal(noise_px);
  }
}

}  // namespace

Scene MakeScene(double noise_px, double stated_px, const std::function<void(Scene&)>& change,
                std::uint64_t seed, int poses) {
  SyntheticOptions options;
  options.seed = 1;
  options.poses = poses;
  options.noise_px = stated_px;
  const SyntheticArray array = MakeSyntheticArray(options);
  Scene scene;
  scene.data = CollectCalibrationData(array.session, array.boards, 0).value();
  scene.truth.array.lenses = {array.lens};
  scene.truth.array.views = array.views;
  scene.truth.poses = array.poses;
  scene.truth.target.boards.resize(2);
  change(scene);
  Random random(1000 + seed);
  ObserveCorners(noise_px, random, scene);
  scene.start = scene.truth;
  scene.start.target = {};
  for (TelecentricLens& lens : scene.start.array.lenses) {
    lens = array.session.NominalLens();
  }
  // About a pixel off; the gauge pose stays where it is.
  for (TelecentricView& view : scene.start.array.views) {
    const Eigen::Vector3d turn(random.Normal(1e-3), random.Normal(1e-3), random.Normal(1e-3));
    view.axes_in_array = (ExpRotation(turn) * view.Rotation()).topRows<2>();
    view.offset_mm += Eigen::Vector2d(random.Normal(0.005), random.Normal(0.005));
  }
  for (std::size_t k = 1; k < scene.start.poses.size(); ++k)
    scene.start.poses[k].origin_in_array_mm +=
        Eigen::Vector3d(random.Normal(0.005), random.Normal(0.005), random.Normal(0.005));
  return scene;
}

BundleOptions With(const LensModel& model) {
  BundleOptions options;
  options.model = model;
  return options;
}

BundleResult MustAdjust(const Scene& scene, const BundleOptions& options) {
  return AdjustBundle(scene.data, scene.start, options).value();
}

}  // namespace telestrain::testing_support
