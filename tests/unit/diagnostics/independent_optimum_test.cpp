#include "diagnostics/independent_optimum.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "unit/calibration/bundle_scene.h"
#include "unit/diagnostics/random_rig.h"

namespace telestrain {
namespace {

using testing_support::MakeScene;
using testing_support::MakeRandomRig;
using testing_support::RandomRig;
using testing_support::Scene;

void Print(const Result<IndependentOptimum>& found) {
    ASSERT_TRUE(found.ok()) << found.error().message;
    std::printf("images %d left %d dres %.3g dm %.3g drot %.3g eval %.3g rms %.12g %.12g conv %d it %d s %.3g %.3g agrees %d\n",
                found->images, found->images_left_out, found->max_residual_difference_px,
                found->max_magnification_difference, found->max_rotation_difference_rad,
                found->evaluated_max_residual_difference_px, found->rms_px, found->mrcal_rms_px,
                found->mrcal_converged, found->iterations, found->seconds, found->mrcal_seconds,
                found->agrees());
}
TEST(Spike, A) {
  for (int poses : {9, 18}) {
    Scene scene = MakeScene(0.1, 0.1, [](Scene&) {}, 1, poses);
    Print(CheckAgainstMrcal(scene.data, scene.truth, scene.start));
  }
}
TEST(Spike, B) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const RandomRig rig = MakeRandomRig(seed);
    Print(CheckAgainstMrcal(rig.data, rig.truth, rig.start));
  }
}

}  // namespace
}  // namespace telestrain
