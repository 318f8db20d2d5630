#include "viz/picture_set.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "visual/results_fixture.h"
#include "viz/scene_from_results.h"

namespace telestrain::viz {
namespace {

// Two states, the second with the larger strain; "points" of two quantities.
Scene TwoStates() {
  Scene scene;
  scene.pipe.emplace();
  for (const double strain : {100.0, 300.0}) {
    PipeState state;
    state.image = "pipe/load_" + std::to_string(static_cast<int>(strain)) + ".png";
    state.axial_microstrain = strain;
    state.surface.values = {{{kAxialStrain, "axial strain", ""}, {0.0, strain}},
                            {{"shear_microstrain", "shear", ""}, {-5.0, 5.0}}};
    scene.pipe->states.push_back(state);
  }
  scene.pipe->largest_state = 1;
  return scene;
}

void ExpectUsage(const Error& error, std::initializer_list<const char*> parts) {
  EXPECT_EQ(error.kind, ErrorKind::kUsage);
  for (const char* part : parts)
    EXPECT_NE(error.message.find(part), std::string::npos) << part << " in " << error.message;
}

TEST(PictureChoices, AreLookedUpInTheScene) {
  const Scene scene = TwoStates();
  RenderOptions options;
  EXPECT_EQ(ChoicesFor(scene, options)->state, 1u);
  EXPECT_EQ(ChoicesFor(scene, options)->quantity, kAxialStrain);
  options.state = "0";
  options.quantity = "shear_microstrain";
  options.range = {-10, 10};
  EXPECT_EQ(ChoicesFor(scene, options)->state, 0u);
  EXPECT_EQ(ChoicesFor(scene, options)->quantity, "shear_microstrain");
  EXPECT_EQ(ChoicesFor(scene, options)->range, options.range);
  options.state = "pipe/load_300.png";
  EXPECT_EQ(ChoicesFor(scene, options)->state, 1u);
}

TEST(PictureChoices, NameTheNearestWhenThereIsNone) {
  const Scene scene = TwoStates();
  RenderOptions options;
  options.state = "pipe/load_310.png";
  ExpectUsage(ChoicesFor(scene, options).error(),
              {"state", "'pipe/load_310.png'", "nearest is 'pipe/load_300.png'", "largest, 0"});
  options.state = "2";
  ExpectUsage(ChoicesFor(scene, options).error(), {"state", "'2'"});
  options = {};
  options.quantity = "shear_microstrian";
  ExpectUsage(ChoicesFor(scene, options).error(),
              {"quantity", "nearest is 'shear_microstrain'", kAxialStrain.c_str()});
  options = {};
  options.view = "aray";
  ExpectUsage(PlanPictures(scene, options).error(), {"view", "nearest is 'array'", "targets"});
}

TEST(PictureChoices, NeedAPipe) {
  RenderOptions options;
  options.range = {0, 1};
  ExpectUsage(ChoicesFor(Scene{}, options).error(), {"telestrain measure"});
  options = {};
  EXPECT_TRUE(ChoicesFor(Scene{}, options).ok());
  options.view = "pipe_strain";
  ExpectUsage(PlanPictures(Scene{}, options).error(), {"pipe_strain", "telestrain measure"});
}

TEST(PictureSet, HasEveryStateInOneRangeAndTheLargestForTheReport) {
  const auto planned = PlanPictures(TwoStates(), {});
  ASSERT_TRUE(planned.ok());
  const auto find = [&](const std::string& name) -> const PlannedPicture* {
    const auto found = std::find_if(planned->begin(), planned->end(),
                                    [&](const auto& p) { return p.file_name == name; });
    return found == planned->end() ? nullptr : &*found;
  };
  const PlannedPicture* largest = find("pipe_strain.png");
  ASSERT_NE(largest, nullptr);
  EXPECT_EQ(largest->choices.state, 1u);
  EXPECT_FALSE(largest->choices.range.has_value());
  for (const std::size_t state : {0u, 1u}) {
    const PlannedPicture* one = find("pipe_strain_00" + std::to_string(state) + ".png");
    ASSERT_NE(one, nullptr) << state;
    EXPECT_EQ(one->choices.state, state);
    // Values from 0 to 300 are on every one.
    EXPECT_EQ(one->choices.range, (std::array<double, 2>{0, 300}));
  }
  EXPECT_EQ(planned->back().file_name, "contact_sheet.png");
  for (const PlannedPicture& picture : *planned) EXPECT_TRUE(IsStandardPicture(picture.file_name));
}

TEST(PictureSet, ASingleStateHasTheNameOfItsFile) {
  RenderOptions options;
  options.view = "pipe_strain";
  EXPECT_EQ(PlanPictures(TwoStates(), options)->front().file_name, "pipe_strain.png");
  options.state = "0";
  EXPECT_EQ(PlanPictures(TwoStates(), options)->front().file_name, "pipe_strain_000.png");
}

TEST(PictureSet, KnowsItsFilesFromOthers) {
  for (const char* name : {"array.png", "pipe_strain.png", "pipe_strain_012.png"})
    EXPECT_TRUE(IsStandardPicture(name)) << name;
  for (const char* name : {"array.jpg", "my_array.png", "array_000.png", "pipe_strain_old.png",
                           "pipe_strain_.png", "notes.txt", ""})
    EXPECT_FALSE(IsStandardPicture(name)) << name;
}

}  // namespace
}  // namespace telestrain::viz
