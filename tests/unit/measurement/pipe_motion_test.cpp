// The pipe in images: moved as a whole, moved far, partly covered or blurred.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/rotation.h"
#include "tests/unit/measurement/pipe_scene.h"

namespace telestrain {
namespace {

using testing_support::Binned;
using testing_support::PipeScene;

constexpr double kStretch = 500e-6;
constexpr double kTurn_rad = 0.2 * 3.14159265358979 / 180;
// Images without noise: the largest bias of a match, 1.2e-3 px, is 0.76 microstrain of the base,
// and not coherent over a patch, whose points move by different parts of a pixel. Along a patch
// of 4 mm the same bias, averaged over the ten rows that a slope takes, is 1.6 microstrain.
constexpr double kLongBase = 0.3e-6, kLocal = 1.6e-6;

class PipeMotion : public ::testing::Test {
 protected:
  static const PipeScene& Scene() {
    static const PipeScene scene(Binned());
    return scene;
  }
  static const GrayImage& Reference() {
    static const GrayImage image = Scene().Render(PipeScene::AtRest());
    return image;
  }
  static PipeOptions Options() {
    PipeOptions options = DefaultPipeOptions(Scene().session);
    options.subset_px = 17;
    return options;
  }
  static PipeSequence Start(int threads = 0) {
    PipeOptions options = Options();
    options.threads = threads;
    return PipeSequence::Start(Scene().session, Scene().array, options, PipeState{}, Reference())
        .value();
  }
  // Before any state; copied, so that it stays so.
  static const PipeSequence& Started() {
    static const PipeSequence sequence = Start();
    return sequence;
  }
  static MeasuredState Measured(const GrayImage& image) {
    PipeSequence sequence = Started();
    return sequence.Measure(PipeState{}, image).value();
  }
  static void ExpectStrain(const MeasuredState& state, double strain) {
    EXPECT_NEAR(state.strain.axial_strain, strain, kLongBase);
    for (const double local : state.strain.local_axial_strain) EXPECT_NEAR(local, strain, kLocal);
  }
  static int Rejected(const MeasuredState& state, const std::string& reason) {
    const auto at = state.strain.points_rejected.find(reason);
    return at == state.strain.points_rejected.end() ? 0 : at->second;
  }
};

// Subsets of 17 px are 0.3 mm on the pipe and hold some ten speckles. That they lie on a curved
// surface must not bias the diameter; what is left is scatter, of which the fit knows.
TEST_F(PipeMotion, TheDiameterIsTrueWithCoarseSubsets) {
  const PipeGrid& grid = Started().grid();
  EXPECT_NEAR(2 * grid.pipe.radius_mm, 2 * PipeScene::kRadius_mm, 3 * grid.sigma_diameter_mm);
  EXPECT_LT(grid.sigma_diameter_mm, 1.6e-3);  // 306 points; 5.5 um off would be seen
}

TEST_F(PipeMotion, MovedAndTurnedAsAWholeIsNoStrain) {
  for (const Eigen::Vector3d& way :
       {Eigen::Vector3d(0.15, 0, 0), Eigen::Vector3d(0, 0.15, 0), Eigen::Vector3d(0, 0, 0.15),
        Eigen::Vector3d(-0.09, 0.08, -0.09)}) {
    DeformedPipe pipe = PipeScene::AtRest();
    pipe.origin_in_array_mm += way;
    pipe.array_from_pipe = ExpRotation(kTurn_rad * Eigen::Vector3d(0.6, -0.5, 0.62).normalized());
    const MeasuredState state = Measured(Scene().Render(pipe));
    ExpectStrain(state, 0);
    // The bias of a match, 21 nm, over the 2 mm from the middle of a patch to its edge.
    EXPECT_NEAR(state.strain.rotation_rad.norm(), kTurn_rad, 1e-5);
  }
}

// A state that is 2 mm on along the pipe is reached in steps, and at once.
TEST_F(PipeMotion, AFarMoveIsFoundAndWhatLeftTheFieldIsNamed) {
  PipeSequence sequence = Started();
  DeformedPipe pipe = PipeScene::AtRest();
  pipe.membrane_strain = kStretch;
  MeasuredState state;
  for (const double along_mm : {0.7, 1.4, 2.0}) {
    pipe.origin_in_array_mm.x() = 0.02 + along_mm;
    state = sequence.Measure(PipeState{}, Scene().Render(pipe)).value();
  }
  const MeasuredState at_once = Measured(Scene().Render(pipe));
  for (const MeasuredState& found : {state, at_once}) {
    ExpectStrain(found, kStretch);
    // 2.0 of the 5.7 mm of a view have left it, with a row of subsets that lies over its border.
    const int points = static_cast<int>(sequence.grid().points.size());
    EXPECT_NEAR(Rejected(found, "outside the image"), points * 2.0 / 5.7, 0.1 * points);
    int rejected = 0;
    for (const auto& [reason, count] : found.strain.points_rejected) rejected += count;
    EXPECT_EQ(found.strain.points_used + rejected, points);
    // Besides them the outlier limit may take a point whose subset nearly left.
    EXPECT_LE(rejected - Rejected(found, "outside the image"), 2);
  }
}

TEST_F(PipeMotion, TheSameStartGivesTheSameBitsForAnyNumberOfThreads) {
  DeformedPipe pipe = PipeScene::AtRest();
  pipe.origin_in_array_mm.x() += 0.1;
  const GrayImage image = Scene().Render(pipe);
  const MeasuredState with_all = Measured(image);
  const MeasuredState with_one = Start(1).Measure(PipeState{}, image).value();
  EXPECT_EQ(with_all.strain.axial_strain, with_one.strain.axial_strain);
  EXPECT_TRUE(with_all.motions == with_one.motions);
}

// Half the step gives four times the points, which hold hardly more than the same pixels do.
TEST_F(PipeMotion, OverlappingSubsetsDoNotPromiseMore) {
  const GrayImage reference = Scene().Photograph(PipeScene::AtRest(), 1.5, 5);
  const GrayImage image = Scene().Photograph(PipeScene::AtRest(), 1.5, 6);
  std::vector<MeasuredState> states;
  for (const int step_px : {17, 9}) {
    PipeOptions options = Options();
    options.step_px = step_px;
    PipeSequence sequence =
        PipeSequence::Start(Scene().session, Scene().array, options, PipeState{}, reference)
            .value();
    states.push_back(sequence.Measure(PipeState{}, image).value());
    EXPECT_LT(std::abs(states.back().strain.axial_strain),
              4 * states.back().strain.standard_uncertainty);
  }
  EXPECT_GT(states[1].strain.points_used, 3 * states[0].strain.points_used);
  // A grid that reaches closer to the border spreads a little more.
  EXPECT_NEAR(states[1].strain.standard_uncertainty / states[0].strain.standard_uncertainty, 1,
              0.25);
}

PixelRegion PartOf(const PixelRegion& region) {
  return {region.x + region.width / 4, region.y + region.height / 4, region.width / 3,
          region.height / 3};
}

// 5 x 5 px mean, twice.
void BlurPart(const PixelRegion& part, GrayImage& image) {
  for (int pass = 0; pass < 2; ++pass) {
    const GrayImage before = image;
    for (int y = part.y; y < part.y + part.height; ++y)
      for (int x = part.x; x < part.x + part.width; ++x) {
        float sum = 0;
        for (int k = 0; k < 25; ++k) sum += before.At(x + k % 5 - 2, y + k / 5 - 2);
        image.At(x, y) = sum / 25;
      }
  }
}

// The pattern of another place, as a wire before the pipe would hide it.
void CoverPart(const PixelRegion& part, GrayImage& image) {
  const GrayImage before = image;
  for (int y = part.y; y < part.y + part.height; ++y)
    for (int x = part.x; x < part.x + part.width; ++x)
      image.At(x, y) = before.At(x - part.width / 2, y + part.height / 2);
}

TEST_F(PipeMotion, ABlurredOrCoveredPartIsLeftOutAndDoesNotBiasTheRest) {
  DeformedPipe pipe = PipeScene::AtRest();
  pipe.membrane_strain = kStretch;
  const GrayImage sound = Scene().Photograph(pipe, 1.5, 3);
  const double clean = Measured(sound).strain.axial_strain;
  for (const auto& spoil : {BlurPart, CoverPart}) {
    GrayImage image = sound;
    spoil(PartOf(Scene().session.views[1].region), image);
    const MeasuredState state = Measured(image);
    const int points = static_cast<int>(state.strain.points_used);
    EXPECT_GT(state.strain.points_rejected.size(), 0u);
    // A ninth of the first group's points, and those whose subsets reach into it.
    const int all = static_cast<int>(Started().grid().points.size());
    EXPECT_GE(all - points, all / 2 / 9 * 8 / 10);
    EXPECT_LE(all - points, all / 2 / 4);
    // What is left is a quarter less of one patch: the noise of both differs by the noise of the
    // part, and is 4 standard uncertainties at most.
    EXPECT_NEAR(state.strain.axial_strain, clean, 4 * state.strain.standard_uncertainty);
  }
}

}  // namespace
}  // namespace telestrain
