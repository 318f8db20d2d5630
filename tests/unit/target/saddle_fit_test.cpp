#include "target/saddle_fit.h"

#include <gtest/gtest.h>

#include "board_renderer.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;

// One corner in the middle of an image without noise or rounding.
struct OneCorner {
  testing::BoardScene scene;
  PixelRegion region{0, 0, 160, 160};
  GrayImage image = testing::Blank(160, 160, 0);

  explicit OneCorner(double blur_px) {
    scene.columns = scene.rows = 1;
    scene.origin_px = {79.3, 80.6};
    scene.side_px << 61, 12, -17, 49;  // the lines do not meet at right angles
    scene.blur_px = blur_px;
    testing::DrawBoard(scene, region, &image);
  }
  SaddleStart Start() const {
    SaddleStart start;
    start.pixel = scene.origin_px;
    start.half_axis_u_px = 0.47 * scene.side_px.col(0);
    start.half_axis_v_px = 0.47 * scene.side_px.col(1);
    start.blur_px = scene.blur_px;
    return start;
  }
};

// The fit stops where a last step leaves 1e-4 blurs by its own estimate; the errors of place and
// blur are of like size here, so that their products, which it counts once, count twice.
TEST(FitSaddle, ThePlaceDoesNotDependOnTheStart) {
  for (const double blur_px : {0.6, 1.5, 3.0}) {
    const OneCorner corner(blur_px);
    for (int i = 0; i < 12; ++i) {
      const double turn = 0.52 * i, off_px = 0.015 * blur_px * (i + 1) + (i > 8 ? 0.3 : 0);
      SaddleStart start = corner.Start();
      start.pixel += off_px * Vector2d(std::cos(turn), std::sin(turn));
      start.blur_px *= 1 + 0.04 * (i % 3 - 1);
      const auto fit = FitSaddle(corner.image, corner.region, start);
      ASSERT_TRUE(fit.has_value()) << blur_px << " " << i;
      EXPECT_LT((fit->point.pixel - corner.scene.origin_px).norm(), 2e-4 * blur_px)
          << blur_px << " " << i;
      EXPECT_NEAR(fit->blur_px, blur_px, 0.005 * blur_px);
    }
  }
}

}  // namespace
}  // namespace telestrain
