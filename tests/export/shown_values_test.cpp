#include "viz/export/shown_values.h"

#include <gtest/gtest.h>

#include "export/small_scene.h"

namespace telestrain::viz {
namespace {

using testing::SmallScene;

TEST(ChooseValues, TakesTheLargestStateAndTheAxialStrainUnlessAskedOtherwise) {
  const auto shown = ChooseValues(SmallScene(), "largest", "");
  ASSERT_TRUE(shown.ok() && shown->has_value());
  EXPECT_EQ((*shown)->state, 1U);
  EXPECT_EQ((*shown)->quantity.key, "axial_microstrain");
  const auto other = ChooseValues(SmallScene(), "pipe/2.png", "hoop_microstrain");
  ASSERT_TRUE(other.ok() && other->has_value());
  EXPECT_EQ((*other)->state, 2U);
  EXPECT_EQ((*other)->quantity.name, "hoop strain");
}

TEST(ChooseValues, SaysWhatThereIs) {
  const auto state = ChooseValues(SmallScene(), "3", "");
  ASSERT_FALSE(state.ok());
  EXPECT_EQ(state.error().kind, ErrorKind::kUsage);
  EXPECT_NE(state.error().message.find("0 to 2"), std::string::npos) << state.error().message;
  const auto quantity = ChooseValues(SmallScene(), "largest", "axial");
  ASSERT_FALSE(quantity.ok());
  EXPECT_EQ(quantity.error().kind, ErrorKind::kUsage);
  EXPECT_NE(quantity.error().message.find("axial_microstrain"), std::string::npos);
}

TEST(ChooseValues, WithoutAPipeThereIsNothingToChoose) {
  Scene scene = SmallScene();
  scene.pipe.reset();
  const auto nothing = ChooseValues(scene, "largest", "");
  ASSERT_TRUE(nothing.ok());
  EXPECT_FALSE(nothing->has_value());
  const auto asked = ChooseValues(scene, "0", "");
  ASSERT_FALSE(asked.ok());
  EXPECT_EQ(asked.error().kind, ErrorKind::kBadInput);
}

}  // namespace
}  // namespace telestrain::viz
