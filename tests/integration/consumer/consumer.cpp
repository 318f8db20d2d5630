// Projects one point with the installed package and checks the pixel by hand.
#include <cmath>
#include <cstdio>

#include "optics/telecentric_lens.h"
#include "optics/telecentric_view.h"

int main() {
  telestrain::TelecentricLens lens;
  lens.magnification_px_per_mm = 200;
  lens.center_px = {1000, 500};
  telestrain::TelecentricView view;
  view.offset_mm = {0.5, 0};
  // No distortion: 1000 + 200 (1 + 0.5) and 500 + 200 * 2; the depth of 7 mm has no effect.
  const Eigen::Vector2d pixel = telestrain::Project(lens, view, {1, 2, 7});
  std::printf("pixel %.3f %.3f\n", pixel.x(), pixel.y());
  return (pixel - Eigen::Vector2d(1300, 900)).norm() < 1e-9 ? 0 : 1;
}
