#include "calibration/bundle_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "base/parallel.h"
#include "geometry/rotation.h"
#include "unit/calibration/bundle_scene.h"

namespace telestrain {
namespace {

using testing_support::MakeScene;
using testing_support::MustAdjust;
using testing_support::Random;
using testing_support::Scene;
using testing_support::With;

// What has to be added to the truth's lens and views, in the order of the covariance.
Eigen::VectorXd ErrorOf(const ArrayCalibration& found, const ArrayCalibration& truth) {
  Eigen::VectorXd error(found.ParameterCount());
  error(0) = found.Magnification_px_per_mm() - truth.Magnification_px_per_mm();
  for (std::size_t i = 0; i < found.views.size(); ++i) {
    const TelecentricView &a = found.views[i], &b = truth.views[i];
    error.segment<3>(1 + 5 * Eigen::Index(i)) =
        LogRotation(a.Rotation() * b.Rotation().transpose());
    error.segment<2>(4 + 5 * Eigen::Index(i)) = a.offset_mm - b.offset_mm;
  }
  return error;
}

TEST(BundleCovariance, PriorsHoldWhatTheCornersCannotSee) {
  const Scene scene =
      MakeScene(0.1, 0.1, [](Scene& s) { s.data.target.sigma_separation_um = 0.25; });
  BundleOptions options;
  options.want_covariance = true;
  const BundleResult result = MustAdjust(scene, options);
  const auto& names = result.covariance.names;
  const auto at = std::find(names.begin(), names.end(), "target.B.shift_mm") - names.begin();
  ASSERT_LT(at, static_cast<std::ptrdiff_t>(names.size()));
  const double sigma_mm = std::sqrt(result.covariance.joint(at, at));
  EXPECT_LE(sigma_mm, 0.25e-3);
  // The poses turn by about 0.01 rad about y and z: the corners know the shift to micrometres only.
  EXPECT_GT(sigma_mm, 0.25e-3 * 0.98);
  const Eigen::MatrixXd certificate =
      result.state.array.covariance - result.state.array.covariance_of_noise;
  EXPECT_GT(certificate.diagonal().minCoeff(), -1e-15);
  EXPECT_GT(certificate.trace(), 0.1 * 0.25e-3 * 0.25e-3);
  // Without the prior the shift is what the data know least of.
  const auto information = InformationOf(scene.data, result.state, options);
  ASSERT_TRUE(information.ok());
  const auto weak = WeakDirections(*information, false, 2);
  const auto bound = WeakDirections(*information, true, 2);
  EXPECT_LT(weak[0].information, 0.01 * bound[0].information);
  EXPECT_TRUE(std::any_of(weak[0].parts.begin(), weak[0].parts.end(),
                          [](const auto& part) { return part.name == "target.B.shift_mm"; }));
}

// The gauge pose is the true one, so lens and views may be compared with the truth one by one.
TEST(BundleCovariance, ErrorsHaveTheStatedCovarianceAndChi2ItsLaw) {
  constexpr int kRuns = 60;
  double normalised = 0, chi2 = 0, freedom = 0;
  Eigen::Index size = 0;
  for (int run = 0; run < kRuns; ++run) {
    Random random(static_cast<std::uint64_t>(run) + 77);
    const Scene scene = MakeScene(
        0.1, 0.1,
        [&](Scene& s) {
          TargetSpec& target = s.data.target;
          target.sigma_square_um = 0.3;
          target.sigma_separation_um = 0.25;
          target.coplanarity_um = 0.5;
          const double height_mm = 0.5e-3 / std::sqrt(3.0);
          s.truth.target.pitch_relative = random.Normal(0.3e-3 / 3.6);
          s.truth.target.boards[1] = {random.Normal(0.25e-3),
                                      random.Normal(height_mm),
                                      random.Normal(height_mm / 1.2),
                                      random.Normal(height_mm / 1.8),
                                      0,
                                      0};
        },
        static_cast<std::uint64_t>(run), 4);
    BundleOptions options;
    options.want_covariance = true;
    const BundleResult result = MustAdjust(scene, options);
    const ArrayCalibration& found = result.state.array;
    const Eigen::VectorXd error = ErrorOf(found, scene.truth.array);
    size = error.size();
    normalised += error.dot(found.covariance.ldlt().solve(error));
    chi2 += result.chi2;
    freedom += result.residual_count - result.parameter_count;
  }
  // Mean of kRuns chi-squares of `size` degrees of freedom, 4 sigma; the covariance is scaled by
  // max(1, sigma0^2), which is 1 % above 1 on average.
  const auto n = static_cast<double>(size);
  EXPECT_NEAR(normalised / kRuns, n, 4 * std::sqrt(2 * n / kRuns) + 0.01 * n);
  // 4 sigma, and the six numbers of the shape that the corners do not all determine.
  EXPECT_NEAR(chi2 / freedom, 1, 4 * std::sqrt(2 / freedom) + 6.0 * kRuns / freedom);
}

// Mean normalised error squared of lens and views over `runs`, divided by their number.
double MeanNormalisedError(int runs, double gross_share, const BundleOptions& options) {
  double normalised = 0;
  for (int run = 0; run < runs; ++run) {
    Scene scene = MakeScene(
        0.1, 0.1, [](Scene&) {}, static_cast<std::uint64_t>(run), 4);
    Random random(static_cast<std::uint64_t>(run) + 500);
    for (BoardData& board : scene.data.boards)
      for (Eigen::Index i = 0; i < board.Count(); ++i)
        if (random.Uniform(0, 1) < gross_share)
          board.pixels.col(i) += Eigen::Vector2d(random.Normal(10), random.Normal(10));
    const ArrayCalibration& found = MustAdjust(scene, options).state.array;
    const Eigen::VectorXd error = ErrorOf(found, scene.truth.array);
    normalised +=
        error.dot(found.covariance.ldlt().solve(error)) / static_cast<double>(error.size());
  }
  return normalised / runs;
}

TEST(BundleCovariance, OfARobustFitIsHonestWithAndWithoutMistakes) {
  constexpr int kRuns = 60;
  constexpr double kNumbers = 21;  // magnification, four views of five
  BundleOptions options;
  options.want_covariance = true;
  options.robust_sigmas = 3;
  // Mean of kRuns chi-squares of 21 degrees of freedom over 21, 4 sigma.
  const double tolerance = 4 * std::sqrt(2 / (kNumbers * kRuns));
  EXPECT_NEAR(MeanNormalisedError(kRuns, 0, options), 1, tolerance);
  EXPECT_NEAR(MeanNormalisedError(kRuns, 0.02, options), 1, tolerance);
}

TEST(BundleCovariance, ALensForEveryViewAndOneImageIsSingularAndTheMessageNamesIt) {
  Scene scene = MakeScene(0.1, 0.1, [](Scene&) {});
  scene.data.images.resize(1);
  std::erase_if(scene.data.boards, [](const BoardData& board) { return board.image > 0; });
  scene.start.poses.resize(1);
  BundleOptions options = With({{}, true, false, true});
  options.want_covariance = true;
  const auto result = AdjustBundle(scene.data, scene.start, options);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kEstimationFailed);
  EXPECT_NE(result.error().message.find("aspect"), std::string::npos) << result.error().message;
}

// Also the buffers of the threads keep nothing from one problem to the next.
TEST(BundleCovariance, TheBytesDoNotDependOnThreadsAndHistory) {
  const Scene scene = MakeScene(0.1, 0.1, [](Scene& s) { s.data.target.flatness_um = 0.5; });
  const LensModel model{{true, false, true, true, false}, true, true, false};
  constexpr int kRuns = 6;
  std::vector<BundleResult> results(kRuns);
  ParallelFor(kRuns, 3, [&](int i) {
    BundleOptions options = With(i % 2 == 0 ? model : LensModel());
    options.want_covariance = true;
    results[static_cast<std::size_t>(i)] = MustAdjust(scene, options);
  });
  for (std::size_t i = 2; i < results.size(); ++i) {
    EXPECT_EQ(results[i].TotalChi2(), results[i % 2].TotalChi2());
    EXPECT_TRUE(results[i].covariance.joint == results[i % 2].covariance.joint);
    EXPECT_TRUE(results[i].covariance.poses[3] == results[i % 2].covariance.poses[3]);
  }
}

}  // namespace
}  // namespace telestrain
