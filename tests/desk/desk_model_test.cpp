#include "viz/desk/desk_model.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "export/small_scene.h"
#include "viz/desk/desk_control.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

using testing::SmallScene;

DeskModel Model() {
  const Scene scene = SmallScene();
  return {"small", scene, *ChooseValues(scene, "largest", "")};
}

TEST(DeskModel, ShowsThePartsOfOneStateAndOfTheVisibleLayers) {
  DeskModel model = Model();
  model.ShowState(2);
  for (const Part& part : model.parts())
    EXPECT_EQ(model.IsVisible(part), part.state == kEveryState || part.state == 2) << part.name;
  model.Toggle(Layer::kViews);
  for (const Part& part : model.parts())
    EXPECT_FALSE(model.IsVisible(part) && part.layer == Layer::kViews) << part.name;
}

TEST(DeskModel, StatesEndAndQuantitiesGoRound) {
  DeskModel model = Model();
  EXPECT_EQ(model.shown()->state, 1U);
  model.StepState(5);
  EXPECT_EQ(model.shown()->state, 2U);
  model.StepState(-9);
  EXPECT_EQ(model.shown()->state, 0U);
  model.StepQuantity(-1);
  EXPECT_EQ(model.shown()->quantity.key, "sigma_um");
  EXPECT_EQ(model.shown()->scale.low, ValueScale(*model.scene().pipe, "sigma_um").low);
  model.StepQuantity(1);
  EXPECT_EQ(model.shown()->quantity.key, "axial_microstrain");
}

TEST(DeskModel, ColoursGoOverAllStatesOrOverTheShownOne) {
  DeskModel model = Model();
  const Pipe& pipe = *model.scene().pipe;
  EXPECT_EQ(model.Bars()[0].note, "range of all states");
  model.ToggleRange();
  for (int state = 1; state < 3; ++state) {
    model.ShowState(state);
    const auto& surface = pipe.states[static_cast<std::size_t>(state)].surface;
    EXPECT_EQ(model.shown()->scale.ticks, ValueScale({&surface}, "axial_microstrain").ticks);
  }
  EXPECT_EQ(model.Bars()[0].note, "range of this state");
  model.ToggleRange();
  EXPECT_EQ(model.shown()->scale.ticks, ValueScale(pipe, "axial_microstrain").ticks);
}

TEST(DeskModel, TellsTheStrainOfTheStateWithItsUncertainty) {
  const auto lines = Model().StateLines();
  EXPECT_EQ(lines[0], "state 1 of 0 to 2");
  EXPECT_EQ(lines[2], "long base: 800.0 \u00b1 22.6 \u00b5\u03b5 (k = 2)");
  Scene unknown = SmallScene();
  for (PipeState& state : unknown.pipe->states) state.standard_uncertainty_microstrain = 0;
  const auto shown = *ChooseValues(unknown, "largest", "");
  EXPECT_EQ(DeskModel("small", unknown, shown).StateLines()[2], "long base: 800.0 \u00b5\u03b5");
}

TEST(DeskModel, ThePipeIsLookedAtWithoutTheViewsInFrontOfIt) {
  DeskModel model = Model();
  model.ArrangeFor(StandardView::kPipe);
  EXPECT_FALSE(model.Shows(Layer::kViews));
  EXPECT_TRUE(model.Shows(Layer::kSurface));
  model.ArrangeFor(StandardView::kArray);
  EXPECT_TRUE(model.Shows(Layer::kViews));
}

TEST(DeskModel, WithoutAPipeThereIsNoStateAndNoQuantity) {
  Scene scene = SmallScene();
  scene.pipe.reset();
  DeskModel model("small", scene, std::nullopt);
  model.StepState(1);
  model.StepQuantity(1);
  EXPECT_EQ(model.States(), 0);
  EXPECT_TRUE(model.Bars().empty());
  EXPECT_EQ(PictureName(model), "telestrain_scene.png");
}

TEST(WriteNew, NeverOverwrites) {
  const auto folder = std::filesystem::path(TELESTRAIN_BINARY_DIR) / "desk_test" / "write_new";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string name = PictureName(Model());
  EXPECT_EQ(name, "telestrain_state_1_axial_microstrain.png");
  for (const std::string wanted :
       {"telestrain_state_1_axial_microstrain.png", "telestrain_state_1_axial_microstrain_2.png",
        "telestrain_state_1_axial_microstrain_3.png"}) {
    const auto path = WriteNew(folder, name, wanted);
    ASSERT_TRUE(path.ok()) << path.error().message;
    EXPECT_EQ(path->filename(), wanted);
  }
  const auto nowhere = WriteNew(folder / "none", name, "bytes");
  ASSERT_FALSE(nowhere.ok());
  EXPECT_EQ(nowhere.error().kind, ErrorKind::kOutputFailed);
}

// A name may have 255 bytes: this one can be reserved, its temporary with ".part1234" not.
TEST(WriteNew, LeavesNothingWhenWritingFails) {
  const auto folder = std::filesystem::path(TELESTRAIN_BINARY_DIR) / "desk_test" / "write_fails";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto failed = WriteNew(folder, std::string(251, 'n') + ".png", "bytes");
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().kind, ErrorKind::kOutputFailed);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace telestrain::viz
