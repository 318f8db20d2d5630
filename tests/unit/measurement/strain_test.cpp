#include "measurement/strain.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/rotation.h"
#include "unit/measurement/certificate_covariance.h"
#include "unit/measurement/virtual_pipe.h"

namespace telestrain {
namespace {

using testing_support::VirtualPipe;

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

constexpr double kKappa_per_mm = 2e-4;  // 0.02 %/mm

// What the same images give to a calibration that takes the lens for telecentric.
VirtualPipe Unaware(VirtualPipe pipe) {
  pipe.array.lenses.front().telecentricity_per_mm = 0;
  return pipe;
}

TEST(Strain, AMoveAlongTheDepthIsNoneToACalibrationThatKnowsTheLens) {
  const VirtualPipe pipe(kKappa_per_mm);
  constexpr double kMove_mm = 0.12;
  const auto tracked = pipe.Track([&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p + kMove_mm * Eigen::Vector3d::UnitZ());
  });
  const StateStrain state = MustAnalyse(pipe, tracked);
  EXPECT_NEAR(state.axial_strain, 0, 1e-3 * kMicro);
  for (const double local : state.local_axial_strain) EXPECT_NEAR(local, 0, 1e-3 * kMicro);
  EXPECT_LT((state.translation_mm - kMove_mm * Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  // To the other each patch grows by kappa times the move along the axes, which are 30 degrees off
  // it. The patches move apart by as much of their images' distance to the lens's axis, which is
  // 2.8 mm from the middle of every view, of the base of 27.7 mm.
  const StateStrain unaware = MustAnalyse(Unaware(pipe), tracked);
  const double growth = kKappa_per_mm * kMove_mm * std::cos(30 * 3.14159265358979 / 180);
  for (const double local : unaware.local_axial_strain)
    EXPECT_NEAR(std::abs(local), growth, 0.1 * growth);  // the rays lean by up to 1e-3 more
  EXPECT_NEAR(std::abs(unaware.axial_strain), growth * 2 * 2.8 / 27.7, 0.1 * growth);
  RecordProperty("axial_microstrain", std::to_string(1e6 * unaware.axial_strain));
  RecordProperty("local_microstrain", std::to_string(1e6 * unaware.local_axial_strain[0]));
}

TEST(Strain, AStretchIsFoundThroughALeaningLens) {
  const VirtualPipe pipe(kKappa_per_mm);
  const double stretch = 750 * kMicro;
  const StateStrain state = MustAnalyse(pipe, pipe.Track([&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p + Eigen::Vector3d(stretch * p.x(), 0, -0.08));
  }));
  EXPECT_NEAR(state.axial_strain, stretch, 1e-3 * kMicro);
  for (const double local : state.local_axial_strain) EXPECT_NEAR(local, stretch, 1e-3 * kMicro);
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

TEST(Strain, TheCertificateOfTheTargetScalesTheStrain) {
  constexpr double kSeparation_mm = 0.25e-3, kBase_mm = 27.7, kStretch = 750 * kMicro;
  VirtualPipe pipe;
  pipe.array.covariance += testing_support::CovarianceOfSeparation(pipe.array, kSeparation_mm);
  const StateStrain state = MustAnalyse(pipe, pipe.Track([](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p + Eigen::Vector3d(kStretch * p.x(), 0, 0));
  }));
  ASSERT_EQ(state.budget[3].source, "target certificate");
  // The base of the grid is 27.7 mm to 1 %.
  EXPECT_NEAR(state.budget[3].standard_uncertainty, kStretch * kSeparation_mm / kBase_mm,
              0.01 * kStretch * kSeparation_mm / kBase_mm);
  EXPECT_EQ(state.budget[2].standard_uncertainty, 0);
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
