#include "viz/rays_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "unit/optics/paper_rig.h"
#include "viz/label_layout.h"
#include "viz/scene/rig_scene.h"

namespace telestrain::viz {
namespace {

using telestrain::testing_support::PaperRig;

// Rendered once for all tests that run together.
struct Drawn {
  OpticalRig rig = PaperRig();
  RigDesign design = AnalyseRig(rig, {}).value();
  Picture picture = DrawRays(rig, design, {1200, 884}).value();
};
const Drawn& PaperPicture() {
  static const Drawn drawn;
  return drawn;
}

const Panel& PanelNamed(const Picture& picture, const std::string& name) {
  const auto at = std::find_if(picture.panels.begin(), picture.panels.end(),
                               [&](const Panel& panel) { return panel.name == name; });
  if (at == picture.panels.end()) throw std::logic_error("no panel " + name);
  return *at;
}

std::array<int, 3> ColorAt(const RgbImage& image, const Eigen::Vector2d& pixel) {
  const auto x = static_cast<std::size_t>(std::lround(pixel.x()));
  const auto y = static_cast<std::size_t>(std::lround(pixel.y()));
  const std::uint8_t* rgb = &image.rgb.at(3 * (y * static_cast<std::size_t>(image.width_px) + x));
  return {rgb[0], rgb[1], rgb[2]};
}

// The part of a line's points whose pixel has the tint of the group: A is blue, B is orange.
double TintedShare(const Picture& picture, const Panel& panel, const Eigen::Vector3d& from_mm,
                   const Eigen::Vector3d& to_mm, bool is_blue) {
  constexpr int kPoints = 200, kTint = 40;
  int tinted = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double share = 0.1 + 0.8 * i / (kPoints - 1);
    const auto color = ColorAt(picture.image, panel.PixelOf(from_mm + share * (to_mm - from_mm)));
    const int red_less_blue = color[0] - color[2];
    tinted += (is_blue ? -red_less_blue : red_less_blue) > kTint ? 1 : 0;
  }
  return static_cast<double>(tinted) / kPoints;
}

TEST(DrawRays, MiddleRaysRunFromTheLastMirrorToTheObjectInTheirGroupsColour) {
  const Drawn& drawn = PaperPicture();
  const Panel& panel = PanelNamed(drawn.picture, "oblique");
  for (const ViewDesign& view : drawn.design.views) {
    const auto corners = view.middle_ray.Corners();
    // Other views' rays and the pipe may cross a tenth of it.
    EXPECT_GT(TintedShare(drawn.picture, panel, corners[3], corners[4], view.group == "A"), 0.85)
        << view.name;
  }
  const Panel& side_view = PanelNamed(drawn.picture, "along pipe");
  // B stands in front of A, seen from +x.
  for (const std::size_t view : {2u, 3u}) {
    const auto corners = drawn.design.views[view].middle_ray.Corners();
    EXPECT_GT(TintedShare(drawn.picture, side_view, corners[3], corners[4], false), 0.85) << view;
  }
  const auto at = [&](double y_mm, double z_mm) { return side_view.PixelOf({0, y_mm, z_mm}); };
  EXPECT_NEAR(at(0, 10).x(), at(0, 30).x(), 0.01) << "z is up";
  EXPECT_LT(at(0, 30).y(), at(0, 10).y());
  EXPECT_GT(at(10, 0).x(), at(-10, 0).x()) << "y is to the right, as seen against x";
}

TEST(DrawRays, MirrorsHaveTheirSizeAndTheSensorsPartsTheColoursOfTheirViews) {
  const Drawn& drawn = PaperPicture();
  const Panel& panel = PanelNamed(drawn.picture, "oblique");
  // The third mirror of A1 stands free on the left.
  const MirrorPlate& plate = drawn.design.views[0].plates[2].plate;
  const Eigen::Vector2d half_mm = 0.5 * plate.Size_mm();
  const Eigen::Vector2d middle_mm = MiddleOf(plate.outline_mm);
  const auto color = [&](double x, double y) {
    const Eigen::Vector2d at_mm = middle_mm + Eigen::Vector2d(x, y).cwiseProduct(half_mm);
    return ColorAt(drawn.picture.image, panel.PixelOf(plate.InArray(at_mm)));
  };
  const std::array<int, 3> white = {255, 255, 255};
  int inside = 0, outside = 0;
  for (const double side : {-0.93, 0.93})
    for (const double along : {-0.5, -0.2, 0.2, 0.5}) {
      inside += color(along, side) != white ? 1 : 0;
      outside += color(along, 1.25 * side) == white ? 1 : 0;
    }
  EXPECT_EQ(inside, 8);
  EXPECT_GE(outside, 6) << "rays leave over one edge";

  const PhysicalCamera& camera = drawn.rig.camera;
  const Eigen::Vector3d origin_mm =
      camera.position_mm + SensorPlane_mm(drawn.rig, drawn.design) * camera.axis;
  for (const OpticalPath& path : drawn.rig.paths) {
    int tinted = 0;
    for (const double x : {-0.3, 0.3})
      for (const double y : {-0.3, -0.15, 0.15, 0.3}) {
        const Eigen::Vector2d ideal_mm =
            path.field_mm.center() + path.field_mm.sizes().cwiseProduct(Eigen::Vector2d(x, y));
        const auto found =
            ColorAt(drawn.picture.image, panel.PixelOf(origin_mm + ideal_mm.x() * camera.image_x +
                                                       ideal_mm.y() * camera.image_y));
        const int red_less_blue = found[0] - found[2];
        tinted += (path.group == "A" ? -red_less_blue : red_less_blue) > 10 ? 1 : 0;
      }
    EXPECT_GE(tinted, 6) << path.name << ": others' rays pass behind two of eight points at most";
  }
}

TEST(DrawRays, NamesEveryMirrorAndOverlapsNoText) {
  const Picture& picture = PaperPicture().picture;
  const auto has = [&](const std::string& wanted) {
    return std::any_of(picture.texts.begin(), picture.texts.end(),
                       [&](const PlacedText& text) { return text.text == wanted; });
  };
  for (const ViewDesign& view : PaperPicture().design.views)
    for (const MirrorDesign& mirror : view.plates)
      EXPECT_TRUE(has(mirror.plate.name)) << mirror.plate.name;
  EXPECT_TRUE(has("A1, B1: M3")) << "one name for mirrors behind one another";
  EXPECT_TRUE(has("60.0\u00b0"));
  for (std::size_t i = 0; i < picture.texts.size(); ++i) {
    const PixelBox& box = picture.texts[i].box;
    EXPECT_GE(picture.texts[i].size_pt, 7);
    EXPECT_TRUE(box.left >= 0 && box.bottom >= 0 && box.Right() <= picture.image.width_px &&
                box.Top() <= picture.image.height_px)
        << picture.texts[i].text;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(Overlap(box, picture.texts[j].box))
          << picture.texts[i].text << " and " << picture.texts[j].text;
  }
}

TEST(DrawRays, DrawsARigWithoutPairsPipeOrMirrors) {
  OpticalRig rig = PaperRig();
  rig.paths.resize(1);
  rig.paths[0].mirrors.clear();
  rig.paths[0].center_in_array_mm = {0, 0, 0};
  rig.pipe_diameter_mm.reset();
  const RigDesign design = AnalyseRig(rig, {}).value();
  const auto picture = DrawRays(rig, design, {1200, 900});
  EXPECT_TRUE(picture.ok()) << picture.error().message;
}

TEST(PlaceLabel, ALeaderGoesRoundOtherLabelsWhenItCan) {
  const std::vector<std::uint8_t> taken(200 * 200, 0);
  const Occupancy occupancy(200, 200, taken);
  LabelRequest request{{100, 100}, {30, 10}, 0, 2, 60, true};
  const PixelBox wall{112, 80, 4, 40};  // to the right, where the label would like to go
  const auto box = PlaceLabel(request, {0, 0, 200, 200}, occupancy, {wall});
  ASSERT_TRUE(box.has_value());
  for (const PixelBox& part : LeaderBoxes(request.anchor_px, *box, request.clearance_px))
    EXPECT_FALSE(Overlap(part, wall));
  request.leader = false;
  const auto beyond = PlaceLabel(request, {0, 0, 200, 200}, occupancy, {wall});
  ASSERT_TRUE(beyond.has_value());
  EXPECT_GT(beyond->left, 116) << "without a leader it jumps over";
}

}  // namespace
}  // namespace telestrain::viz
