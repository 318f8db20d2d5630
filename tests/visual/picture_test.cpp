#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "visual/results_fixture.h"
#include "viz/label_layout.h"
#include "viz/pictures.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_from_results.h"

namespace telestrain::viz {
namespace {

using visual_test::FreshFolder;
using visual_test::WriteResults;

const RenderOptions kSmall{1200, 740};

Scene FixtureScene(const std::string& name, const visual_test::FixtureContent& content = {}) {
  const auto folder = FreshFolder(name);
  WriteResults(folder, content);
  const auto scene = SceneFromResults(folder);
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
  return scene.ok() ? *scene : Scene{};
}

const Panel* FindPanel(const Picture& picture, const std::string& name) {
  for (const Panel& panel : picture.panels)
    if (panel.name == name) return &panel;
  return nullptr;
}

std::array<int, 3> ColorAt(const RgbImage& image, const Eigen::Vector2d& pixel) {
  const auto x = static_cast<std::size_t>(std::lround(pixel.x()));
  const auto y = static_cast<std::size_t>(std::lround(pixel.y()));
  const std::uint8_t* rgb = &image.rgb.at(3 * (y * static_cast<std::size_t>(image.width_px) + x));
  return {rgb[0], rgb[1], rgb[2]};
}

int LargestDifference(const std::array<int, 3>& a, const std::array<std::uint8_t, 3>& b) {
  int largest = 0;
  for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// A text of the picture whose box overlaps another one's or leaves the picture.
std::string MisplacedText(const Picture& picture) {
  const auto& texts = picture.texts;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const PixelBox& box = texts[i].box;
    if (box.left < 0 || box.bottom < 0 || box.Right() > picture.image.width_px ||
        box.Top() > picture.image.height_px)
      return texts[i].text + " leaves the picture";
    for (std::size_t j = 0; j < i; ++j)
      if (Overlap(box, texts[j].box)) return texts[i].text + " overlaps " + texts[j].text;
  }
  return "";
}

bool HasText(const Picture& picture, const std::string& part) {
  for (const PlacedText& text : picture.texts)
    if (text.text.find(part) != std::string::npos) return true;
  return false;
}

TEST(DrawPipeStrain, ColourAtAPointIsTheColourOfItsStrain) {
  const Scene scene = FixtureScene("StrainColour");
  const auto picture = DrawPipeStrain(scene, {});
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const ColorScale scale = StrainScale(scene.pipe->Largest().surface);
  const ColorMap colors = ColorMap::Viridis(scale.low, scale.high);
  // A step of the table changes a channel by 3 at most, and half a pixel off changes the strain by
  // less than a step.
  constexpr int kTolerance = 4;
  for (const auto& [panel_name, sign] :
       {std::pair{"group A", -1.0}, {"group B", 1.0}, {"pipe", 1.0}})
    for (const double offset_x_mm : {-1.9, 0.4, 1.7})
      for (const double y_mm : {-1.2, -0.3, 0.4}) {
        const Panel* panel = FindPanel(*picture, panel_name);
        ASSERT_NE(panel, nullptr);
        const double x_mm = sign * 13.851 + offset_x_mm;
        const double z_mm = visual_test::kPipeAxisZ_mm +
                            std::sqrt(std::pow(visual_test::kPipeRadius_mm, 2) - y_mm * y_mm);
        if (std::string(panel_name) == "pipe" && std::abs(offset_x_mm) < 1) continue;  // line above
        const auto found = ColorAt(picture->image, panel->PixelOf({x_mm, y_mm, z_mm}));
        const auto wanted = BytesOf(colors.At(visual_test::PipeStrain_microstrain(x_mm, y_mm)));
        EXPECT_LE(LargestDifference(found, wanted), kTolerance)
            << panel_name << " x " << x_mm << " y " << y_mm;
      }
}

TEST(DrawPipeStrain, PrintsNoUncertaintyWhereNoneIsStated) {
  Scene scene = FixtureScene("NoUncertainty");
  scene.pipe->states[scene.pipe->largest_state].standard_uncertainty_microstrain = 0;
  const auto picture = DrawPipeStrain(scene, kSmall);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_TRUE(HasText(*picture, "\u03b5 = 812.4 \u00b5\u03b5"));
  EXPECT_FALSE(HasText(*picture, "\u00b1"));
}

TEST(DrawPipeStrain, NamesAndAveragesTheQuantityThatIsShown) {
  Scene scene = FixtureScene("Words");
  Surface& surface = scene.pipe->states[scene.pipe->largest_state].surface;
  const std::size_t points = surface.points_in_array_mm.size();
  surface.values.push_back({{"made_up_um", "uncertainty along the pipe", "\u00b5m"}, {}});
  for (std::size_t i = 0; i < points; ++i)
    surface.values.back().values.push_back(surface.group[i] == 0 ? 2.0 : 4.0);
  const auto picture = DrawPipeStrain(scene, kSmall, {std::nullopt, "made_up_um", std::nullopt});
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_TRUE(HasText(*picture, "group A: mean 2.0"));
  EXPECT_TRUE(HasText(*picture, "group B: mean 4.0"));
  EXPECT_FALSE(HasText(*picture, "of the pipe of"));
  EXPECT_FALSE(HasText(*picture, "change against the reference state"));
}

TEST(DrawPipe, NamesEveryGaugeWithItsReading) {
  Scene scene = FixtureScene("Gauges");
  Pipe& pipe = *scene.pipe;
  PipeState& state = pipe.states[pipe.largest_state];
  pipe.gauges.clear();
  state.gauge_microstrain.clear();
  for (const double side : {1.0, -1.0}) {
    Gauge gauge;
    gauge.name = side > 0 ? "front" : "back";
    gauge.outward_in_array = -side * AxesOf(scene).across;
    gauge.center_in_array_mm =
        pipe.axis_point_in_array_mm + pipe.radius_mm * gauge.outward_in_array;
    pipe.gauges.push_back(gauge);
    state.gauge_microstrain.push_back(side > 0 ? 700.0 : 650.5);
  }
  const auto picture = DrawPipe(scene, kSmall);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_TRUE(HasText(*picture, "front: 700.0 \u00b5\u03b5"));
  EXPECT_TRUE(HasText(*picture, "back: 650.5 \u00b5\u03b5, behind"));
}

TEST(DrawTargets, RulersOutsideTheLimitStandOut) {
  Scene scene = FixtureScene("FailedRuler");
  ASSERT_GT(scene.rulers.size(), 1u);
  for (RulerPosition& ruler : scene.rulers) ruler.verdict = "pass";
  scene.rulers.front().verdict = "fail";
  const auto picture = DrawTargets(scene, kSmall);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_TRUE(HasText(*picture, "1 ruler position outside the limit"));
  EXPECT_EQ(MisplacedText(*picture), "");
}

TEST(DrawPipeStrain, TellsTheLongBaseStrainWithItsUncertainty) {
  const auto picture = DrawPipeStrain(FixtureScene("StrainText"), kSmall);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_TRUE(HasText(*picture,
                      "27.702 mm:  \u03b5 = 812.4 \u00b5\u03b5 \u00b1 22.6 \u00b5\u03b5 (k = 2)"));
  EXPECT_EQ(MisplacedText(*picture), "");
}

TEST(DrawTargets, OutlineHasTheColourOfItsResidual) {
  Scene scene = FixtureScene("TargetColour", {.ruler = false, .pipe = false});
  scene.boards.resize(1);  // nothing in front of it
  const auto picture = DrawTargets(scene, {});
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const ColorScale scale = ResidualScale(scene.boards);
  const auto wanted = BytesOf(ColorMap::Plasma(scale.low, scale.high).At(scene.boards[0].rms_px));
  const auto& outline = scene.boards[0].outline_in_array_mm;
  const Panel* panel = FindPanel(*picture, "group A");
  ASSERT_NE(panel, nullptr);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d middle = 0.5 * (outline[i] + outline[(i + 1) % 4]);
    // The line is 5 px wide; edge smoothing leaves its middle alone.
    EXPECT_LE(LargestDifference(ColorAt(picture->image, panel->PixelOf(middle)), wanted), 2) << i;
  }
}

TEST(DrawTargets, CountsWhatWasRejected) {
  const auto picture = DrawTargets(FixtureScene("TargetCounts"), kSmall);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_TRUE(HasText(*picture, "24 boards"));
  EXPECT_TRUE(HasText(*picture, "1 board view rejected"));
  EXPECT_TRUE(HasText(*picture, "17 ruler positions"));
  EXPECT_TRUE(HasText(*picture, "1 ruler image rejected"));
  EXPECT_EQ(MisplacedText(*picture), "");
}

TEST(DrawArray, NamesEveryViewBesideItsVolume) {
  const Scene scene = FixtureScene("ArrayNames");
  const auto picture = DrawArray(scene, kSmall);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  for (const ViewVolume& view : scene.views) EXPECT_TRUE(HasText(*picture, view.name));
  EXPECT_EQ(MisplacedText(*picture), "");
  for (const PlacedText& text : picture->texts) EXPECT_GE(text.size_pt, 7) << text.text;
  const auto& rgb = picture->image.rgb;
  const auto white = static_cast<double>(std::count(rgb.begin(), rgb.end(), 255));
  EXPECT_GT(white / static_cast<double>(rgb.size()), 0.3);
  EXPECT_LT(white / static_cast<double>(rgb.size()), 0.95);
}

TEST(DrawArray, BearsLongAndStrangeNames) {
  Scene scene = FixtureScene("ArrayLongNames", {.ruler = false, .pipe = false});
  scene.views[0].name = "a view with $x^2$ | a\nname of more than a line can take, and then some";
  const auto picture = DrawArray(scene, kSmall);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_TRUE(HasText(*picture, "a view with $x^2$ | a na\u2026"));
  EXPECT_EQ(MisplacedText(*picture), "");
}

TEST(DrawArray, SaysWhatIsMissing) {
  const Scene scene = FixtureScene("ArrayMissing", {.ruler = false, .pipe = false});
  const auto array = DrawArray(scene, kSmall), targets = DrawTargets(scene, kSmall);
  ASSERT_TRUE(array.ok() && targets.ok());
  EXPECT_TRUE(HasText(*array, "no pipe measured"));
  EXPECT_TRUE(HasText(*targets, "no ruler measured"));
}

TEST(DrawArray, VolumesAreDrawnWhereTheyAre) {
  const Scene scene = FixtureScene("ArrayVolumes", {.ruler = false, .pipe = false});
  const auto picture = DrawArray(scene, kSmall);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const Panel* panel = FindPanel(*picture, "array");
  ASSERT_NE(panel, nullptr);
  // Group A's volumes are tinted blue, group B's orange.
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    const ViewVolume& view = scene.views[i];
    const Eigen::Vector3d inside = view.center_in_array_mm - 4.0 * view.axis_in_array +
                                   0.35 * view.width_mm * view.image_x_in_array;
    const auto color = ColorAt(picture->image, panel->PixelOf(inside));
    if (view.group == "A")
      EXPECT_GT(color[2], color[0] + 4) << view.name;
    else
      EXPECT_GT(color[0], color[2] + 4) << view.name;
  }
}

}  // namespace
}  // namespace telestrain::viz
