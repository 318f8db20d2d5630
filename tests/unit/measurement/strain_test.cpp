#include "measurement/strain.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "geometry/rotation.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::Random;
using testing_support::SyntheticArray;

using Motion = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

// Points on an 8 mm pipe in both fields and where their images go under a motion; no image
// involved.
struct VirtualPipe {
  ArrayCalibration array;
  PipeGrid grid;

  VirtualPipe() {
    const SyntheticArray synthetic = MakeSyntheticArray({});
    array.lens = synthetic.lens;
    array.views = synthetic.views;
    array.covariance = Eigen::MatrixXd::Zero(21, 21);
    grid.pipe.axis_point_mm = {0, 0, -4};
    grid.pipe.radius_mm = 4;
    grid.step_px = 61;
    for (int g = 0; g < 2; ++g)
      grid.pairs.push_back(
          {g == 0 ? "A" : "B", 2 * g, 2 * g + 1, {0, 0.5, -0.866}, {0, -0.5, -0.866}});
    for (int g = 0; g < 2; ++g)
      for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 12; ++column) AddPoint(g, row, column);
  }

  void AddPoint(int g, int row, int column) {
    const double angle = (row - 4) * 0.06;
    const Eigen::Vector3d wanted((g == 0 ? -13.85 : 13.85) + (column - 5.5) * 0.268,
                                 4 * std::sin(angle), 4 * std::cos(angle) - 4);
    PipePoint point;
    point.group = g;
    point.row = row;
    point.column = column;
    const auto pixel = [&](int side, const Eigen::Vector3d& p) {
      return Project(array.lens, array.views[static_cast<std::size_t>(2 * g + side)], p);
    };
    // The surface point that the whole first pixel sees, so that both pixels are exact.
    point.first_center_px = pixel(0, wanted).array().round().cast<int>();
    const TelecentricView& view = array.views[static_cast<std::size_t>(2 * g)];
    const Eigen::Vector3d ray = view.RayDirection();
    const auto surface = grid.pipe.Enter(
        view.PointOnRay(array.lens.IdealFromPixel(point.first_center_px.cast<double>())),
        ray.z() < 0 ? ray : Eigen::Vector3d(-ray));
    point.reference_in_array_mm = surface.value();
    point.second_pixel = pixel(1, point.reference_in_array_mm);
    point.second_center_px = point.second_pixel.array().round().cast<int>();
    grid.points.push_back(point);
  }

  std::vector<TrackedPoint> Track(const Motion& motion, double noise_px = 0,
                                  std::uint64_t seed = 1) const {
    Random random(seed);
    std::vector<TrackedPoint> tracked;
    for (const PipePoint& point : grid.points) {
      // The exact material point of the first pixel on the second view's ray.
      const Eigen::Vector3d moved = motion(point.reference_in_array_mm);
      const Eigen::Vector3d from = point.reference_in_array_mm;
      TrackedPoint t;
      t.zncc = 1;
      for (int side = 0; side < 2; ++side) {
        const int view = 2 * point.group + side;
        const auto& v = array.views[static_cast<std::size_t>(view)];
        const Eigen::Vector2d at =
            side == 0 ? point.first_center_px.cast<double>() : point.second_pixel;
        Eigen::Vector2d pixel = at + Project(array.lens, v, moved) - Project(array.lens, v, from);
        pixel += Eigen::Vector2d(random.Normal(noise_px), random.Normal(noise_px));
        t.measured[static_cast<std::size_t>(side)] = {
            view, pixel, noise_px * noise_px * Eigen::Matrix2d::Identity()};
      }
      tracked.push_back(t);
    }
    return tracked;
  }
};

constexpr double kMicro = 1e-6;

StateStrain MustAnalyse(const VirtualPipe& pipe, const std::vector<TrackedPoint>& tracked) {
  auto result = AnalyseState(pipe.array, pipe.grid, tracked);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return std::move(result).value();
}

TEST(Strain, RigidMotionGivesZeroStrainAndIsReported) {
  const VirtualPipe pipe;
  for (const double angle : {0.0, 0.001, 0.0035, 0.02}) {
    const Eigen::Matrix3d turn = ExpRotation(angle * Eigen::Vector3d(0.5, 0.6, -0.62));
    const Eigen::Vector3d shift(0.1, -0.15, 0.12);
    const StateStrain state = MustAnalyse(pipe, pipe.Track([&](const Eigen::Vector3d& p) {
      return Eigen::Vector3d(turn * p + shift);
    }));
    EXPECT_NEAR(state.axial_strain, 0, 1e-3 * kMicro) << angle;
    for (const double local : state.local_axial_strain) EXPECT_NEAR(local, 0, 1e-3 * kMicro);
    EXPECT_LT((state.rotation_rad - LogRotation(turn)).norm(), 1e-9);
    EXPECT_EQ(state.points_used, static_cast<int>(pipe.grid.points.size()));
    EXPECT_TRUE(state.points_rejected.empty());
  }
}

TEST(Strain, AKnownStretchIsFoundWhateverTheMotion) {
  const VirtualPipe pipe;
  const double stretch = 750 * kMicro, contraction = -0.31 * stretch;
  const Eigen::Matrix3d turn = ExpRotation({0.002, -0.003, 0.0015});
  const StateStrain state = MustAnalyse(pipe, pipe.Track([&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d strained((1 + stretch) * p.x(), (1 + contraction) * p.y(),
                                   (1 + contraction) * (p.z() + 4) - 4);
    return Eigen::Vector3d(turn * strained + Eigen::Vector3d(0.05, 0.1, -0.1));
  }));
  EXPECT_NEAR(state.axial_strain, stretch, 1e-3 * kMicro);
  for (int g = 0; g < 2; ++g) {
    EXPECT_NEAR(state.local_axial_strain[static_cast<std::size_t>(g)], stretch, 1e-3 * kMicro);
    EXPECT_NEAR(state.local_hoop_strain[static_cast<std::size_t>(g)], contraction, 0.01 * kMicro);
  }
  for (const PointResult& point : state.points)
    EXPECT_NEAR(point.axial_strain, stretch, 0.01 * kMicro);
}

TEST(Strain, PointsThatDoNotFollowThePipeAreTakenOut) {
  const VirtualPipe pipe;
  auto tracked = pipe.Track([](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p + Eigen::Vector3d(100 * kMicro * p.x(), 0, 0));
  });
  tracked[7].measured[0].pixel.x() += 3;
  tracked[50].measured[1].pixel.y() += 2;
  tracked[120].reason = "low correlation";
  const StateStrain state = MustAnalyse(pipe, tracked);
  EXPECT_NEAR(state.axial_strain, 100 * kMicro, 0.01 * kMicro);
  EXPECT_EQ(state.points_used, static_cast<int>(pipe.grid.points.size()) - 3);
  EXPECT_FALSE(state.points[7].used);
  EXPECT_FALSE(state.points[50].used);
}

TEST(Strain, StatedNoiseIsTheScatter) {
  const VirtualPipe pipe;
  constexpr int kTrials = 200;
  double squares = 0, predicted = 0;
  int within = 0;
  for (int t = 0; t < kTrials; ++t) {
    const StateStrain state =
        MustAnalyse(pipe, pipe.Track([](const Eigen::Vector3d& p) { return p; }, 0.005, 10 + t));
    ASSERT_EQ(state.budget[0].source, "image noise");
    const double noise = state.budget[0].standard_uncertainty;
    squares += state.axial_strain * state.axial_strain / kTrials;
    predicted += noise * noise / kTrials;
    within += std::abs(state.axial_strain) < 2 * noise;
    EXPECT_GE(state.standard_uncertainty, noise);
  }
  // A standard deviation from 200 trials scatters by 5 %; 4 sigma.
  EXPECT_NEAR(std::sqrt(predicted), std::sqrt(squares), 0.2 * std::sqrt(squares));
  EXPECT_GE(within, 181);  // 95.4 % of 200 less 3 sigma of the binomial
}

TEST(Strain, TooFewPointsAreAnErrorThatNamesTheGroup) {
  const VirtualPipe pipe;
  auto tracked = pipe.Track([](const Eigen::Vector3d& p) { return p; });
  for (std::size_t i = 0; i < tracked.size() / 2 - 3; ++i) tracked[i].reason = "outside";
  const auto result = AnalyseState(pipe.array, pipe.grid, tracked);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().message.find("group 'A'"), std::string::npos);
}

}  // namespace
}  // namespace telestrain
