#include "calibration/calibration_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/calibrate.h"
#include "geometry/rotation.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::SyntheticArray;
using testing_support::SyntheticOptions;

ArrayCalibration Exact(const SyntheticArray& array) {
  ArrayCalibration calibration;
  calibration.lenses = {array.lens};
  calibration.views = array.views;
  const int size = calibration.ParameterCount();
  calibration.covariance = calibration.covariance_of_noise = Eigen::MatrixXd::Zero(size, size);
  return calibration;
}

const Change& Find(const std::vector<Change>& changes, const std::string& quantity) {
  for (const Change& change : changes)
    if (change.quantity == quantity) return change;
  ADD_FAILURE() << quantity;
  return changes.front();
}

std::vector<Change> Compare(const SyntheticArray& array, const ArrayCalibration& old_array,
                            const ArrayCalibration& new_array) {
  auto changes = CompareCalibrations(array.session, old_array, new_array);
  EXPECT_TRUE(changes.ok());
  return *changes;
}

TEST(CalibrationComparison, AnotherArrayFrameIsNoChange) {
  const SyntheticArray array = MakeSyntheticArray({});
  const ArrayCalibration old_array = Exact(array);
  ArrayCalibration moved = old_array;
  const Eigen::Matrix3d turn = ExpRotation({0.004, -0.003, 0.005});
  const Eigen::Vector3d shift(0.05, -0.03, 0.04);
  for (TelecentricView& view : moved.views) {
    view.axes_in_array = (view.axes_in_array * turn.transpose()).eval();
    view.offset_mm -= view.axes_in_array * shift;
    view.depth_offset_mm -= view.depth_sense * view.RayDirection().dot(shift);
  }
  for (const Change& change : Compare(array, old_array, moved))
    EXPECT_NEAR(change.value, 0, 1e-6) << change.quantity;
}

// 100 ppm over the 5.7 mm of a field.
TEST(CalibrationComparison, AChangedMagnificationIsAScaleInEveryField) {
  const SyntheticArray array = MakeSyntheticArray({});
  const ArrayCalibration old_array = Exact(array);
  ArrayCalibration larger = old_array;
  larger.lenses[0].magnification_px_per_mm *= 1 + 1e-4;
  const auto changes = Compare(array, old_array, larger);
  const double width_mm = 1296 / larger.lenses[0].magnification_px_per_mm;
  for (const char* view : {"A1", "A2", "B1", "B2"})
    EXPECT_NEAR(Find(changes, std::string("scale over the width of ") + view).value,
                1000 * 1e-4 * width_mm, 0.002);  // second order: 1e-4 of it, and the fit's turn
}

// Both views of group B look 1 um further along x: the fields are 1 um further apart.
TEST(CalibrationComparison, AGroupThatMovedIsADistanceAndAStrain) {
  const SyntheticArray array = MakeSyntheticArray({});
  const ArrayCalibration old_array = Exact(array);
  ArrayCalibration moved = old_array;
  for (std::size_t v : {2u, 3u})
    moved.views[v].offset_mm -= moved.views[v].axes_in_array * Eigen::Vector3d(0.001, 0, 0);
  const auto changes = Compare(array, old_array, moved);
  const double longer_um = Find(changes, "distance between the fields of A and B").value;
  EXPECT_NEAR(longer_um, 1, 0.01);
  // A point at rest seems to move back: 1 um over 27.7 mm are 36 microstrain.
  EXPECT_NEAR(Find(changes, "strain that the drift of A and B would feign").value, -36.1, 0.4);
}

TEST(CalibrationComparison, FreshNoiseIsWithinTheStatedUncertainty) {
  SyntheticOptions options;
  const SyntheticArray first = MakeSyntheticArray(options);
  SyntheticArray second = first;
  testing_support::Random random(77);
  for (BoardObservation& board : second.boards)
    for (auto& corner : board.corners)
      corner->pixel += Eigen::Vector2d(random.Normal(0.1), random.Normal(0.1));
  for (BoardObservation& board : second.boards)  // noise on noise: twice the variance
    for (auto& corner : board.corners) corner->covariance_px2 *= 2;
  const auto a = Calibrate(first.session, first.boards);
  const auto b = Calibrate(second.session, second.boards);
  ASSERT_TRUE(a.ok() && b.ok());
  const auto changes = Compare(first, a->bundle.state.array, b->bundle.state.array);
  int significant = 0;
  for (const Change& change : changes) {
    EXPECT_GT(change.standard_uncertainty, 0) << change.quantity;
    significant += change.IsSignificant();
  }
  // 18 quantities beyond 3 sigma with 0.27 % each, and the shared noise makes them smaller still.
  EXPECT_EQ(significant, 0);
}

TEST(CalibrationComparison, OtherViewsAreBadInput) {
  const SyntheticArray array = MakeSyntheticArray({});
  ArrayCalibration other = Exact(array);
  other.views[1].name = "C7";
  const auto result = CompareCalibrations(array.session, other, Exact(array));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kBadInput);
}

}  // namespace
}  // namespace telestrain
