#include "diagnostics/projection_uncertainty.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "diagnostics/length_uncertainty.h"
#include "geometry/rotation.h"
#include "unit/calibration/bundle_scene.h"

namespace telestrain {
namespace {

using testing_support::MakeScene;
using testing_support::MakeSyntheticArray;
using testing_support::MustAdjust;
using testing_support::Random;
using testing_support::Scene;
using testing_support::With;

constexpr double kNoise_px = 0.1;
constexpr double kSeparation_mm = 0.25e-3;

void Certify(Scene& scene) {
  scene.data.target.sigma_square_um = 0.3;
  scene.data.target.sigma_separation_um = 1000 * kSeparation_mm;
  scene.data.target.coplanarity_um = 0.5;
}

// The true target within its certificate.
void Deviate(Scene& scene, Random& random) {
  const double height_mm = 0.5e-3 / std::sqrt(3.0);
  scene.truth.target.pitch_relative = random.Normal(0.3e-3 / 3.6);
  scene.truth.target.boards[1] = {random.Normal(kSeparation_mm),
                                  random.Normal(height_mm),
                                  random.Normal(height_mm / 1.2),
                                  random.Normal(height_mm / 1.8),
                                  0,
                                  0};
}

MeanMotionCovariance CovarianceAt(const CalibrationData& data, const ArrayState& state,
                                  const BundleOptions& options = {}) {
  return CovarianceWithMeanMotion(data, state, options, 1).value();
}

struct Place {
  int view;
  Eigen::Vector2d pixel;
  double depth_mm;
};

// Middle and corner of a field of either group, and a corner in front of the middle plane.
std::vector<Place> Places(const Session& session) {
  const PixelRegion &a = session.views[0].region, &b = session.views[3].region;
  return {{0, a.Middle(), 0},
          {0, {a.x, a.y}, 0},
          {3, b.Middle(), 0},
          {3, {b.x + b.width - 1, b.y}, 0},
          {3, {b.x + b.width - 1, b.y}, -1.5}};
}

// By how much the calibration that was found projects the place elsewhere than the truth does,
// with the point tied to the target: no linearisation.
Eigen::Vector2d ErrorAt(const Place& place, const ArrayState& found, const ArrayState& truth) {
  const Eigen::Vector3d point = truth.array.RayOf(place.view, place.pixel).At(place.depth_mm);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < truth.poses.size(); ++k) {
    const Eigen::Vector3d in_target =
        truth.poses[k].array_from_target.transpose() * (point - truth.poses[k].origin_in_array_mm);
    sum += found.poses[k].array_from_target * in_target + found.poses[k].origin_in_array_mm;
  }
  return found.array.Project(place.view, sum / double(truth.poses.size())) - place.pixel;
}

struct Sampled {
  std::vector<double> normalised;  // mean of e^T C^-1 e, per place
  double length = 0;               // the same of the length between the fields' middles
};

Sampled Sample(int runs, bool certified) {
  const Session session = MakeSyntheticArray({}).session;
  const std::vector<Place> places = Places(session);
  const auto certify = [&](Scene& s) { certified ? Certify(s) : void(); };
  const Scene exact = MakeScene(0, kNoise_px, certify, 1, 4);
  const auto covariance = CovarianceAt(exact.data, exact.truth);
  const auto length = LengthUncertaintyOf(session, exact.truth.array, covariance).value();
  std::vector<Eigen::Matrix2d> inverse;
  for (const Place& place : places)
    inverse.push_back(
        UncertaintyAt(exact.truth.array, covariance, place.view, place.pixel, place.depth_mm)
            .of_everything.cov_px2.inverse());
  Sampled sampled{std::vector<double>(places.size()), 0};
  for (int run = 0; run < runs; ++run) {
    Random random(static_cast<std::uint64_t>(run) + 31);
    const Scene scene = MakeScene(
        kNoise_px, kNoise_px,
        [&](Scene& s) {
          certify(s);
          if (certified) Deviate(s, random);
        },
        static_cast<std::uint64_t>(run), 4);
    const ArrayState found = MustAdjust(scene, {}).state;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector2d error = ErrorAt(places[i], found, scene.truth);
      sampled.normalised[i] += error.dot(inverse[i] * error) / runs;
    }
    const double found_mm = LengthUncertaintyOf(session, found.array, covariance)->length_mm;
    const double error = 1000 * (found_mm - length.length_mm) / length.length_um.of_everything;
    sampled.length += error * error / runs;
  }
  return sampled;
}

class SampledUncertainty : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(WithoutAndWithCertificate, SampledUncertainty, testing::Bool());

TEST_P(SampledUncertainty, IsTheScatterOfRepeatedCalibrations) {
  constexpr int kRuns = 120;
  const Sampled sampled = Sample(kRuns, GetParam());
  // Mean of kRuns chi-squares of two degrees of freedom, 4 sigma; of one for the length.
  for (const double normalised : sampled.normalised)
    EXPECT_NEAR(normalised, 2, 4 * std::sqrt(4.0 / kRuns));
  EXPECT_NEAR(sampled.length, 1, 4 * std::sqrt(2.0 / kRuns));
}

// Another image comes first, and so another pose is held fixed.
void ReverseImages(Scene& scene) {
  std::reverse(scene.data.images.begin(), scene.data.images.end());
  std::reverse(scene.truth.poses.begin(), scene.truth.poses.end());
  const int last = static_cast<int>(scene.data.images.size()) - 1;
  for (BoardData& board : scene.data.boards) board.image = last - board.image;
  std::stable_sort(scene.data.boards.begin(), scene.data.boards.end(),
                   [](const BoardData& a, const BoardData& b) { return a.image < b.image; });
}

void MoveRigidly(ArrayState& state) {
  const Eigen::Matrix3d turn = ExpRotation({0.3, -0.2, 0.5});
  const Eigen::Vector3d shift(4, -3, 2);
  for (TelecentricView& view : state.array.views) {
    const Eigen::Vector3d axis = view.ViewingDirection();
    view.axes_in_array = view.axes_in_array * turn.transpose();
    view.offset_mm -= view.axes_in_array * shift;
    view.depth_offset_mm -= (turn * axis).dot(shift);
  }
  for (TargetPose& pose : state.poses) {
    pose.array_from_target = turn * pose.array_from_target;
    pose.origin_in_array_mm = turn * pose.origin_in_array_mm + shift;
  }
  state.stage_axis_in_array = turn * state.stage_axis_in_array;
}

std::vector<UncertaintyMap> MapsOf(const Scene& scene, const BundleOptions& options) {
  return UncertaintyMaps(MakeSyntheticArray({}).session, scene.truth.array,
                         CovarianceAt(scene.data, scene.truth, options), {5, 4, 0.7});
}

void ExpectSameMaps(const std::vector<UncertaintyMap>& a, const std::vector<UncertaintyMap>& b) {
  // The scaled information has a condition number of some 1e4, its inverse as many roundings.
  constexpr double kRounding = 1e-10;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t i = 0; i < a[v].nodes.size(); ++i)
      for (const auto part : {&MapNode::of_everything, &MapNode::of_noise}) {
        const Eigen::Matrix2d cov = (a[v].nodes[i].*part).cov_px2;
        EXPECT_LT((cov - (b[v].nodes[i].*part).cov_px2).norm(), kRounding * cov.norm());
      }
}

TEST(ProjectionUncertainty, DoesNotDependOnWhichPoseIsHeldFixedNorOnTheFrame) {
  Scene scene = MakeScene(0, kNoise_px, Certify);
  scene.truth.array.model = {{true, false, true, true, false}, false, true, false};
  const BundleOptions options = With(scene.truth.array.model);
  const auto maps = MapsOf(scene, options);
  Scene moved = scene;
  MoveRigidly(moved.truth);
  ExpectSameMaps(maps, MapsOf(moved, options));
  Scene reversed = scene;
  ReverseImages(reversed);
  ExpectSameMaps(maps, MapsOf(reversed, options));
  // The views' own covariance does: it holds how well the array knows the fixed pose.
  const Eigen::MatrixXd a = CovarianceAt(scene.data, scene.truth, options).of_noise;
  const Eigen::MatrixXd b = CovarianceAt(reversed.data, reversed.truth, options).of_noise;
  EXPECT_GT((a - b).norm(), 0.01 * a.norm());
}

// The distance of the boards is the distance of the fields: all of it shows in the views of the
// second board and nothing in those of the first, which the target's frame is tied to.
TEST(ProjectionUncertainty, HoldsTheTargetsCertificate) {
  const Scene scene = MakeScene(
      0, kNoise_px, [](Scene& s) { s.data.target.sigma_separation_um = 1000 * kSeparation_mm; });
  const auto maps = MapsOf(scene, {});
  const double m = scene.truth.array.Magnification_px_per_mm();
  for (std::size_t v = 0; v < maps.size(); ++v) {
    const TelecentricView& view = scene.truth.array.views[v];
    const double wanted = view.group == "B" ? kSeparation_mm * m * view.axes_in_array(0, 0) : 0;
    const MapNode& node = maps[v].nodes.front();
    const double found = (node.of_everything.cov_px2 - node.of_noise.cov_px2)(0, 0);
    // The boards' x turns by up to 4 degrees against the array's: 1 - cos^2, of the larger one.
    EXPECT_NEAR(found, wanted * wanted, 0.005 * std::pow(kSeparation_mm * m, 2)) << view.name;
  }
}

TEST(ProjectionUncertainty, OfAMapIsThatOfItsPixelsAndSummarised) {
  const Scene scene = MakeScene(0, kNoise_px, Certify);
  const auto covariance = CovarianceAt(scene.data, scene.truth);
  const Session session = MakeSyntheticArray({}).session;
  const UncertaintyMap map = UncertaintyMaps(session, scene.truth.array, covariance)[2];
  ASSERT_EQ(map.nodes.size(), 300U);
  const PixelRegion& region = session.views[2].region;
  EXPECT_EQ(map.nodes.back().pixel,
            Eigen::Vector2d(region.x + region.width - 1, region.y + region.height - 1));
  double mean_px = 0, largest_um = 0;
  for (const MapNode& node : map.nodes) {
    mean_px += node.of_noise.worst_px / 300;
    largest_um = std::max(largest_um, node.of_everything.worst_um);
    const MapNode one = UncertaintyAt(scene.truth.array, covariance, 2, node.pixel, 0);
    EXPECT_EQ(one.of_everything.cov_px2, node.of_everything.cov_px2);
    EXPECT_GE(node.of_noise.worst_px * node.of_noise.worst_px,
              node.of_noise.cov_px2.diagonal().maxCoeff() * (1 - 1e-12));  // rounding
  }
  EXPECT_NEAR(map.of_noise.mean_px, mean_px, 1e-12 * mean_px);  // 300 roundings
  EXPECT_EQ(map.of_everything.largest_um, largest_um);
}

}  // namespace
}  // namespace telestrain
