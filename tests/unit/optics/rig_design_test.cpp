#include "optics/rig_design.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "unit/optics/paper_rig.h"

namespace telestrain {
namespace {

using testing_support::PaperRig;

RigDesign Analyse(const OpticalRig& rig, const DesignOptions& options = {}) {
  const auto design = AnalyseRig(rig, options);
  EXPECT_TRUE(design.ok()) << (design.ok() ? "" : design.error().message);
  return design.ok() ? *design : RigDesign{};
}

DesignCheck Check(const RigDesign& design, const std::string& part) {
  for (const DesignCheck& check : design.checks)
    if (check.what.find(part) != std::string::npos) return check;
  throw std::logic_error("no check " + part);
}

const MirrorDesign& MirrorAt(const RigDesign& design, std::size_t view, std::size_t mirror) {
  return design.views.at(view).plates.at(mirror);
}

// The numbers of measurement-model.md section 13, which are given to three decimals.
TEST(PaperDesign, HasTheNumbersOfTheDrawing) {
  const RigDesign design = Analyse(PaperRig());
  EXPECT_NEAR(design.total_field_mm, 33.404, 1e-3);
  EXPECT_NEAR(*design.field_gap_mm, 22.000, 1e-3);
  EXPECT_NEAR(*design.base_length_mm, 27.702, 1e-3);
  EXPECT_NEAR(design.path_spread_mm, 0, 1e-9);
  for (const ViewDesign& view : design.views) {
    EXPECT_NEAR(view.field_mm.x(), 5.702, 1e-3);
    EXPECT_NEAR(view.field_mm.y(), 4.277, 1e-3);
    EXPECT_NEAR(view.focus_path_mm, 110.14, 5e-3) << "32 mm above the first mirror";
    EXPECT_NEAR(view.first_mirror_path_mm, 78.14, 5e-3);
    EXPECT_EQ(view.handedness, design.views.front().handedness);
  }
  for (const PairDesign& pair : design.pairs) {
    EXPECT_NEAR(pair.stereo_angle_rad, std::numbers::pi / 3, 1e-12);
    EXPECT_NEAR(pair.common_mm.x(), 5.702, 1e-3);
    EXPECT_NEAR(pair.common_mm.y(), 2 * 2.469, 1e-3);
    EXPECT_NEAR(pair.depth_spread_mm, 2.469, 1e-3);
    EXPECT_NEAR(pair.overlap_percent, 100, 0.1);  // the drawing's points are rounded to 1 um
    EXPECT_NEAR(pair.facing.z(), 1, 1e-12);
  }
  EXPECT_TRUE(design.AllHold());
}

TEST(PaperDesign, MirrorsForTheChiefRaysAreTheFieldOverTheCosine) {
  const RigDesign design = Analyse(PaperRig());
  const double width_mm = testing_support::kFieldWidth_mm;
  const double height_mm = testing_support::kFieldHeight_mm;
  for (std::size_t view = 0; view < 4; ++view) {
    const Eigen::Vector2d first = MirrorAt(design, view, 0).chief_size_mm;
    EXPECT_NEAR(first.x(), height_mm * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(first.y(), width_mm, 1e-9);
    const Eigen::Vector2d second = MirrorAt(design, view, 1).chief_size_mm;
    EXPECT_NEAR(second.x(), width_mm * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(second.y(), height_mm, 1e-9);
    const Eigen::Vector2d third = MirrorAt(design, view, 2).chief_size_mm;
    EXPECT_NEAR(third.x(), width_mm, 1e-9);
    EXPECT_NEAR(third.y(), height_mm / std::cos(std::numbers::pi / 6), 1e-9);
  }
}

TEST(PaperDesign, TheApertureAddsItsConeAtTheDistanceOfTheMirror) {
  DesignOptions options;
  options.numerical_aperture = 0.02;
  const RigDesign design = Analyse(PaperRig(), options);
  const double lever_mm[] = {78.143, 66.431, 46.188};
  for (std::size_t mirror = 0; mirror < 3; ++mirror) {
    // Across the plane of incidence a cone of half-angle a has the radius lever tan(a). Corners of
    // a 16-sided rim lie up to 1 - cos(pi/16) = 1.9 % inside; tilted field edges add 2.5 mm of
    // lever.
    const Eigen::Vector2d radius = MirrorAt(design, 0, mirror).cone_radius_mm;
    const double across_mm = mirror == 0 ? radius.y() : mirror == 1 ? radius.y() : radius.x();
    EXPECT_GT(across_mm, 0.98 * 0.02 * (lever_mm[mirror] - 2.5)) << mirror;
    EXPECT_LT(across_mm, 0.02001 * (lever_mm[mirror] + 5)) << mirror;
  }
  EXPECT_EQ(Analyse(PaperRig()).numerical_aperture, DiffractionAperture(3.1));
  EXPECT_NEAR(DiffractionAperture(3.1), 0.01332, 1e-5);
}

TEST(PaperDesign, FirstAndSecondMirrorsShareEdgesAndThirdOnesDoNot) {
  const RigDesign design = Analyse(PaperRig());
  EXPECT_EQ(design.overlapping_plates, 0);
  for (std::size_t view = 0; view < 4; ++view) {
    EXPECT_TRUE(MirrorAt(design, view, 0).is_cut);
    EXPECT_TRUE(MirrorAt(design, view, 1).is_cut);
    EXPECT_FALSE(MirrorAt(design, view, 2).is_cut);
    EXPECT_EQ(design.views[view].chief_loss_percent, 0);
    EXPECT_EQ(design.views[view].blocked_percent, 0);
  }
}

// A pixel at the distance d from a straight edge loses the part of a disc of radius r beyond it: in
// the mean over 0 <= d <= r this is 2 / (3 pi) = 0.2122.
TEST(PaperDesign, LightLostAtSharedEdgesIsThatOfADisc) {
  DesignOptions options;
  options.numerical_aperture = 0.01;
  const RigDesign design = Analyse(PaperRig(), options);
  const double radius_mm = 0.01 * 78.143, share = 2 / (3 * std::numbers::pi);
  const double wanted =
      100 * share *
      (radius_mm / testing_support::kFieldWidth_mm + radius_mm / testing_support::kFieldHeight_mm);
  // Light beyond both edges counts once (-0.1), the second mirrors' edges cut the same rays again;
  // 64 rays and 33 x 25 pixels sample to 3 %.
  for (const ViewDesign& view : design.views) EXPECT_NEAR(view.light_loss_percent, wanted, 0.5);
}

TEST(PaperDesign, NoApertureLosesNoLight) {
  DesignOptions options;
  options.numerical_aperture = 1e-4;
  const RigDesign design = Analyse(PaperRig(), options);
  for (const ViewDesign& view : design.views) EXPECT_LT(view.light_loss_percent, 0.2);
}

TEST(PaperDesign, ASmallerMirrorLosesThePixelsOfItsRim) {
  DesignOptions options;
  options.numerical_aperture = 1e-4;
  options.mirror_sizes_mm = {{20, 20}, {20, 20}, {0.8 * 5.7024, 20}};
  const RigDesign design = Analyse(PaperRig(), options);
  // A fifth of the columns; 33 columns tell it to 2 of them.
  for (const ViewDesign& view : design.views) EXPECT_NEAR(view.chief_loss_percent, 20, 6.1);
  const DesignCheck check = Check(design, "chief ray");
  EXPECT_FALSE(check.ok);
  EXPECT_FALSE(design.AllHold());
  options.mirror_sizes_mm.clear();
  options.mirror_margin_mm = -0.5;
  EXPECT_FALSE(Check(Analyse(PaperRig(), options), "chief ray").ok);
}

TEST(PaperDesign, WithoutMirrorsLeftAllLightIsLost) {
  DesignOptions options;
  options.mirror_margin_mm = -10;
  const RigDesign design = Analyse(PaperRig(), options);
  for (const ViewDesign& view : design.views) {
    EXPECT_EQ(view.chief_loss_percent, 100);
    EXPECT_NEAR(view.light_loss_percent, 100, 1e-9);
  }
  EXPECT_TRUE(design.gaps.empty());
}

// Second mirrors that reach down to the pipe stand in the last part of the way.
TEST(PaperDesign, MirrorsThatAreTooHighStandInTheWay) {
  DesignOptions options;
  options.mirror_sizes_mm = {{7, 6}, {12, 90}};
  const RigDesign design = Analyse(PaperRig(), options);
  EXPECT_FALSE(Check(design, "blocked").ok);
  ASSERT_FALSE(design.blocked.empty());
  EXPECT_EQ(design.blocked.front().view, "A1");
  EXPECT_EQ(design.blocked.front().plate.substr(3), "M2");
  EXPECT_GT(design.views.front().blocked_percent, 10);
}

// On a flat object depth is y sin(30 deg); on the pipe the curve adds R (1 - cos) cos(30 deg).
TEST(PaperDesign, SharpArcOfThePipeEndsWhereTheDepthIsHalfTheDepthOfField) {
  OpticalRig rig = PaperRig();
  rig.depth_of_field_mm = 2.0;
  const PairDesign pair = Analyse(rig).pairs.front();
  double low = 0, high = std::numbers::pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double angle = 0.5 * (low + high);
    const double depth_mm = 4 * std::sin(angle) * 0.5 + 4 * (1 - std::cos(angle)) * std::sqrt(0.75);
    (depth_mm < 1.0 ? low : high) = angle;
  }
  // Steps of pi / 3600 of the radius at either end, and 1 um of the drawing.
  EXPECT_NEAR(*pair.sharp_arc_mm, 2 * 4 * low, 2 * 4 * std::numbers::pi / 3600 + 2e-3);
  EXPECT_GT(*pair.seen_arc_mm, *pair.sharp_arc_mm);
}

TEST(PaperDesign, TheSameRigElsewhereHasTheSameDesign) {
  const OpticalRig rig = PaperRig();
  OpticalRig moved = rig;
  const Eigen::Vector3d shift_mm(3, -7, 11);
  moved.camera.position_mm += shift_mm;
  for (OpticalPath& path : moved.paths) {
    path.center_in_array_mm += shift_mm;
    for (Mirror& mirror : path.mirrors) mirror.point_mm += shift_mm;
  }
  const RigDesign here = Analyse(rig), there = Analyse(moved);
  EXPECT_NEAR(here.total_field_mm, there.total_field_mm, 1e-11);
  for (std::size_t view = 0; view < 4; ++view)
    for (std::size_t mirror = 0; mirror < 3; ++mirror)
      EXPECT_LT((MirrorAt(here, view, mirror).plate.Size_mm() -
                 MirrorAt(there, view, mirror).plate.Size_mm())
                    .norm(),
                1e-11);
}

TEST(RigDesign, FailsWithTheViewAndTheMirrorThatItsRayMisses) {
  OpticalRig rig = PaperRig();
  rig.paths[2].mirrors[0].normal = {-std::sqrt(0.5), 0, std::sqrt(0.5)};
  const auto design = AnalyseRig(rig, {});
  ASSERT_FALSE(design.ok());
  EXPECT_EQ(design.error().kind, ErrorKind::kBadInput);
  EXPECT_NE(design.error().message.find("view 'B1': the ray runs away from mirror 2"),
            std::string::npos)
      << design.error().message;
}

TEST(RigDesign, FailsWithoutViews) { EXPECT_FALSE(AnalyseRig(OpticalRig{}, {}).ok()); }

TEST(RigDesign, AViewOfAnotherHandednessIsFound) {
  OpticalRig rig = PaperRig();
  // A fourth mirror on the way down: the view is upright then and looks from elsewhere.
  OpticalPath& path = rig.paths.back();
  const Eigen::Vector3d down = VirtualCamera(rig, path).axis;
  path.mirrors.push_back({path.center_in_array_mm - 20 * down, Eigen::Vector3d(0, -1, 0)});
  const Eigen::Vector3d after = path.mirrors.back().ReflectDirection(down);
  path.center_in_array_mm = path.mirrors.back().point_mm + 20 * after;
  const RigDesign design = Analyse(rig);
  const DesignCheck check = Check(design, "handedness");
  EXPECT_EQ(check.value, 1);
  EXPECT_FALSE(check.ok);
  EXPECT_EQ(design.views.back().handedness, -design.views.front().handedness);
}

TEST(RigDesign, ASingleViewHasNoPairAndNoMirrorNeedsNoPlate) {
  OpticalRig rig = PaperRig();
  rig.paths.resize(1);
  rig.paths[0].mirrors.clear();
  rig.paths[0].center_in_array_mm = {0, 0, 0};
  const RigDesign design = Analyse(rig);
  EXPECT_TRUE(design.pairs.empty());
  EXPECT_FALSE(design.field_gap_mm.has_value());
  EXPECT_NEAR(design.total_field_mm, testing_support::kFieldHeight_mm, 1e-12);
  EXPECT_EQ(design.views.front().light_loss_percent, 0);
}

TEST(RigDesign, ATiltedPairLosesOverlap) {
  OpticalRig rig = PaperRig();
  // The last mirror of A1 moved by 1 mm along the pipe's image: its field leaves the partner's.
  for (Mirror& mirror : rig.paths[0].mirrors) mirror.point_mm.x() -= 1;
  rig.paths[0].center_in_array_mm.x() -= 1;
  const RigDesign design = Analyse(rig);
  EXPECT_LT(design.pairs.front().overlap_percent, 90);
  EXPECT_FALSE(Check(design, "overlap of A1").ok);
  EXPECT_TRUE(Check(design, "overlap of B1").ok);
}

}  // namespace
}  // namespace telestrain
