#include "calibration/cross_validation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/calibrate.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::MustCalibrate;
using testing_support::SyntheticArray;
using testing_support::SyntheticOptions;

TEST(CrossValidation, UnseenImagesArePredictedToTheNoise) {
  SyntheticOptions options;
  options.poses = 10;
  const Calibration calibration = MustCalibrate(MakeSyntheticArray(options));
  const CrossValidation& validation = calibration.cross_validation;
  EXPECT_EQ(validation.folds, 5);
  // 18720 scalars: the normalised rms scatters by 0.5 %; the array's own noise adds about
  // parameters / residuals = 0.2 %. 4 sigma and that.
  EXPECT_NEAR(validation.normalised_rms, 1, 0.025);
  EXPECT_NEAR(validation.rms_px, validation.expected_rms_px, 0.025 * validation.expected_rms_px);
  EXPECT_FALSE(validation.worst_image.empty());
}

// An image of a bent target fits nothing else: cross-validation names it.
TEST(CrossValidation, AnImageThatDoesNotBelongIsNamed) {
  SyntheticOptions options;
  options.poses = 10;
  SyntheticArray array = MakeSyntheticArray(options);
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t c = 0; c < 117; ++c)
      array.boards[4 * 7 + v].corners[c]->pixel.x() +=
          0.03 * static_cast<double>(c % 13 * (c % 13)) / 12;
  const Calibration calibration = MustCalibrate(array);
  EXPECT_EQ(calibration.cross_validation.worst_image, array.boards[28].image);
  EXPECT_GT(calibration.cross_validation.worst_normalised_rms, 1.2);
}

TEST(CrossValidation, TooFewPosesAreNotParted) {
  SyntheticOptions options;
  options.poses = 5;
  EXPECT_EQ(MustCalibrate(MakeSyntheticArray(options)).cross_validation.folds, 0);
}

}  // namespace
}  // namespace telestrain
