#include "optics/rig_sensitivity.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "unit/optics/paper_rig.h"

namespace telestrain {
namespace {

using testing_support::PaperRig;

const MirrorSensitivity& Find(const std::vector<MirrorSensitivity>& table, const std::string& view,
                              int mirror, MirrorError error) {
  for (const MirrorSensitivity& s : table)
    if (s.view == view && s.mirror == mirror && s.error == error) return s;
  throw std::logic_error("no such entry");
}

// Incidence on the mirrors of the paper's paths, from their normals.
constexpr double kCosine[] = {0.70710678118654752, 0.70710678118654752, 0.86602540378443865};

class PaperSensitivity : public testing::TestWithParam<std::string> {
 protected:
  const MirrorSensitivity& At(int mirror, MirrorError error) const {
    return Find(table_, GetParam(), mirror, error);
  }
  const std::vector<MirrorSensitivity> table_ = SensitivityOf(PaperRig());
};

// Reflection doubles a turn across the plane of incidence and takes 2 cos(incidence) of one within.
TEST_P(PaperSensitivity, ATurnOfAMirrorTurnsTheViewByTheLawOfReflection) {
  for (int mirror = 0; mirror < 3; ++mirror) {
    // Central differences of a turn of 1e-3 are off by its cube, 1e-9 rad.
    EXPECT_NEAR(At(mirror, MirrorError::kTurnAcross).direction_mrad, 2, 5e-6);
    EXPECT_NEAR(At(mirror, MirrorError::kTurnInPlane).direction_mrad, 2 * kCosine[mirror], 5e-6);
    EXPECT_EQ(At(mirror, MirrorError::kShift).direction_mrad, 0);
  }
}

// The image of a point moves by twice the shift along the normal; across the light 2 d sin(i) of
// that is seen.
TEST_P(PaperSensitivity, AShiftMovesTheFieldByTwiceItsPartAcrossTheLight) {
  for (int mirror = 0; mirror < 3; ++mirror) {
    const double sine = std::sqrt(1 - kCosine[mirror] * kCosine[mirror]);
    const double wanted_mm = 2 * kMirrorShift_mm * sine;
    // Rounding of 100 mm.
    EXPECT_NEAR(At(mirror, MirrorError::kShift).field_shift_mm, wanted_mm, 1e-12);
    EXPECT_NEAR(At(mirror, MirrorError::kShift).field_shift_px, wanted_mm * 500 / 2.2, 1e-9);
  }
}

TEST_P(PaperSensitivity, ATurnMovesTheFieldByItsLeverToTheObject) {
  // Way from each mirror to the object: section 13's points.
  const double lever_mm[] = {78.143, 66.431, 46.188};
  for (int mirror = 0; mirror < 3; ++mirror)
    // The points of the drawing are rounded to 0.5 um: 1 um in a lever, 2e-6 mm here.
    EXPECT_NEAR(At(mirror, MirrorError::kTurnAcross).field_shift_mm, 2e-3 * lever_mm[mirror], 4e-6);
}

TEST_P(PaperSensitivity, LengthChangesByHalfOfOneViewsShiftAlongThePipe) {
  // The second mirror's shift moves one view of the pair along the pipe; the triangulated point
  // goes half as far. The sign is that of the shift against the base.
  const MirrorSensitivity& s = At(1, MirrorError::kShift);
  EXPECT_NEAR(std::abs(*s.length_error_um), 500 * s.field_shift_mm, 1e-6);
  EXPECT_NEAR(*s.strain_error_microstrain, 1e3 * *s.length_error_um / (2 * 13.851), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Views, PaperSensitivity, testing::Values("A1", "A2", "B1", "B2"));

TEST(RigSensitivity, DoesNotDependOnTheSideThatANormalPointsTo) {
  const OpticalRig rig = PaperRig();
  OpticalRig turned = rig;
  for (OpticalPath& path : turned.paths)
    for (Mirror& mirror : path.mirrors) mirror.normal = -mirror.normal;
  const auto table = SensitivityOf(rig), other = SensitivityOf(turned);
  ASSERT_EQ(table.size(), 36u);
  ASSERT_EQ(other.size(), table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    // Rounding of 100 mm, as micrometres.
    EXPECT_NEAR(*table[i].length_error_um, *other[i].length_error_um, 1e-9);
    EXPECT_NEAR(*table[i].stereo_angle_mrad, *other[i].stereo_angle_mrad, 1e-9);
  }
}

TEST(RigSensitivity, SaysNothingAboutALengthWithoutTwoPairs) {
  OpticalRig rig = PaperRig();
  rig.paths.erase(rig.paths.begin());
  const auto table = SensitivityOf(rig);
  EXPECT_FALSE(table.front().length_error_um.has_value());
  EXPECT_FALSE(table.front().stereo_angle_mrad.has_value()) << "A2 has lost its partner";
  EXPECT_TRUE(table.back().stereo_angle_mrad.has_value());
}

}  // namespace
}  // namespace telestrain
