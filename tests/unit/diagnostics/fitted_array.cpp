#include "unit/diagnostics/fitted_array.h"

#include <gtest/gtest.h>

namespace telestrain::testing_support {

FittedArray FitArray(const FitOptions& options) {
  FittedArray fitted;
  fitted.array = MakeSyntheticArray(options.synthetic);
  if (options.truth) {
    options.truth(fitted.array);
    ObserveAgain(fitted.array, options.synthetic.noise_px, options.synthetic.seed + 7777777);
  }
  if (options.corners) options.corners(fitted.array);
  fitted.data = *CollectCalibrationData(fitted.array.session, fitted.array.boards);
  ArrayState start;
  start.array.lenses = {fitted.array.lens};
  TelecentricLens& lens = start.array.lenses.front();  // a perfect one
  lens.distortion = {};
  lens.aspect = 1;
  lens.telecentricity_per_mm = 0;
  start.array.views = fitted.array.views;
  start.poses = fitted.array.poses;
  auto bundle = AdjustBundle(fitted.data, start, options.bundle);
  EXPECT_TRUE(bundle.ok());
  fitted.state = bundle.ok() ? bundle->state : start;
  return fitted;
}

void ShiftCorners(SyntheticArray& array, std::size_t image, std::size_t view,
                  const PixelShift& shift) {
  for (auto& corner : array.boards[image * array.views.size() + view].corners)
    if (corner) corner->pixel += shift(corner->pixel);
}

}  // namespace telestrain::testing_support
