#pragma once

#include <cstdint>
#include <functional>

#include "calibration/bundle_adjustment.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain::testing_support {

// A true instrument and target, their corners, and a start about a pixel off whose gauge pose is
// the true one, so that lens and views may be compared with the truth number by number.
struct Scene {
  CalibrationData data;
  ArrayState truth, start;
};

// `change` alters the truth and the certificate before the corners are observed with `noise_px`;
// their stated noise is `stated_px`.
Scene MakeScene(double noise_px, double stated_px, const std::function<void(Scene&)>& change,
                std::uint64_t seed = 1, int poses = 9);

BundleOptions With(const LensModel& model);

// Throws when the adjustment fails.
BundleResult MustAdjust(const Scene& scene, const BundleOptions& options);

}  // namespace telestrain::testing_support
