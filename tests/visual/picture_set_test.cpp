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

// Of a view, that is to be planned alone.
PlannedPicture PlannedView(const RenderOptions& options) {
  const auto planned = PlanPictures(TwoStates(), options);
  EXPECT_TRUE(planned.ok()) << planned.error().message;
  if (!planned.ok()) return {};
  EXPECT_EQ(planned->size(), 1u);
  return planned->front();
}

TEST(PictureSet, AViewIsThePictureOfItsNameInTheSet) {
  const auto set = PlanPictures(TwoStates(), {});
  ASSERT_TRUE(set.ok());
  for (const char* state : {"largest", "0", "1"}) {
    RenderOptions options;
    options.view = "pipe_strain";
    options.state = state;
    const PlannedPicture view = PlannedView(options);
    const auto same = std::find_if(set->begin(), set->end(), [&](const PlannedPicture& picture) {
      return picture.file_name == view.file_name;
    });
    ASSERT_NE(same, set->end()) << view.file_name;
    EXPECT_EQ(view.choices.state, same->choices.state);
    EXPECT_EQ(view.choices.quantity, same->choices.quantity);
    EXPECT_EQ(view.choices.range, same->choices.range) << state;
  }
}

TEST(PictureSet, AnotherQuantityOrRangeHasANameOfItsOwn) {
  RenderOptions options;
  options.view = "pipe_strain";
  options.state = "0";
  options.quantity = kAxialStrain;  // the one that is shown anyway
  EXPECT_EQ(PlannedView(options).file_name, "pipe_strain_000.png");
  options.quantity = "shear_microstrain";
  EXPECT_EQ(PlannedView(options).file_name, "pipe_strain_000_shear_microstrain.png");
  // From -5 to 5 in both states, rounded to steps of the colour bar.
  EXPECT_EQ(PlannedView(options).choices.range, (std::array<double, 2>{-6, 6}));
  options.range = {-2.5, 2};
  EXPECT_EQ(PlannedView(options).file_name, "pipe_strain_000_shear_microstrain_-2.5_to_2.png");
  EXPECT_EQ(PlannedView(options).choices.range, options.range);
  options.state = "largest";
  options.quantity.clear();
  EXPECT_EQ(PlannedView(options).file_name, "pipe_strain_-2.5_to_2.png");
  for (const char* name : {"pipe_strain_000_shear_microstrain.png", "pipe_strain_-2.5_to_2.png"})
    EXPECT_FALSE(IsStandardPicture(name)) << name;
}

TEST(PictureSet, RefusesWhatHasNoEffect) {
  RenderOptions state, quantity, range;
  state.state = "0";
  quantity.quantity = "shear_microstrain";
  range.range = {0, 1};
  for (RenderOptions options : {state, quantity, range}) {
    ExpectUsage(PlanPictures(TwoStates(), options).error(), {"--view pipe_strain"});
    options.view = "array";
    ExpectUsage(PlanPictures(TwoStates(), options).error(), {"'array'", "for: pipe_strain"});
    options.view = "pipe_strain";
    EXPECT_TRUE(PlanPictures(TwoStates(), options).ok());
  }
}

TEST(PictureSet, SaysWhatAViewIsMissing) {
  const auto message = [](const char* view) {
    RenderOptions options;
    options.view = view;
    const auto planned = PlanPictures(Scene{}, options);
    return planned.ok() ? std::string() : planned.error().message;
  };
  EXPECT_NE(message("rays").find("gives no mirrors"), std::string::npos) << message("rays");
  EXPECT_NE(message("residuals").find("residuals.csv; run 'telestrain calibrate'"),
            std::string::npos);
  EXPECT_NE(message("pipe").find("'telestrain measure'"), std::string::npos);
}

TEST(PictureSet, NamesTheStateThatLacksTheQuantity) {
  Scene scene = TwoStates();
  scene.pipe->states[1].surface.values.pop_back();
  RenderOptions options;
  options.view = "pipe_strain";
  options.quantity = "shear_microstrain";
  ExpectUsage(PlanPictures(scene, options).error(),
              {"state 1 ('pipe/load_300.png')", "'shear_microstrain'"});
}

TEST(PictureSet, TakesEveryViewThatItNames) {
  const std::vector<std::string> names = ViewNames();
  EXPECT_EQ(names.size() + 1, PictureKinds().size());  // all but the contact sheet
  for (const std::string& name : names) {
    RenderOptions options;
    options.view = name;
    const auto planned = PlanPictures(TwoStates(), options);
    const std::string message = planned.ok() ? "" : planned.error().message;
    EXPECT_EQ(message.find("there is no view"), std::string::npos) << name;
  }
  RenderOptions sheet;
  sheet.view = "contact_sheet";
  ExpectUsage(PlanPictures(TwoStates(), sheet).error(), {"there is no view 'contact_sheet'"});
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
