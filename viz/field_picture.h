#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/result.h"
#include "viz/image_backdrop.h"
#include "viz/pictures.h"

namespace telestrain::viz {

// The part of the pictures that an image takes, px: with its scales as wide as the picture.
inline constexpr int kFieldImageWidth_px = 1832, kFieldImageHeight_px = 1560;

// A point of a grid over an image.
struct FieldSample {
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();          // in the image
  Eigen::Vector2d arrow_px = Eigen::Vector2d::Zero();       // displacement, in px of the image
  double value = std::numeric_limits<double>::quiet_NaN();  // shown as a colour; NaN: none
  bool is_point = false;  // false: nothing is drawn, as outside of a mask
  bool failed = false;    // marked with a cross
};

// What a picture of a field over an image shows.
struct FieldScene {
  std::string title;               // shortened in the middle where it is too long
  std::vector<std::string> facts;  // lines below the title
  std::string value_name;          // with the unit, over the colour bar
  bool arrows = false;
  bool grid_dots = false;            // one at every point that did not fail
  std::string failure = "no match";  // what a cross means
  int columns = 0, rows = 0, step_px = 0, subset_px = 0;
  std::vector<FieldSample> samples;  // row by row
  // Whether a pixel of the image lies in the region; none: all do. Its edge is drawn and what lies
  // outside is faded.
  std::function<bool(int x, int y)> inside;
  std::vector<std::string> notes;  // small lines at the foot
};

// Draws the field as colours over the image, whose texture shows through as lighter and darker
// without changing the mean colour; arrows enlarged by a round, stated factor; one square of the
// subset's size; the bar with unit and limits. The map is viridis: even in lightness, so that it
// reads the same in grey and for colour-blind readers. The panel "image" maps (x, y, 0) px of the
// image to the picture. Fails (kOutputFailed) when rendering does. The same scene gives the same
// pixels on one kind of CPU.
Result<Picture> DrawField(const ImageBackdrop& backdrop, const FieldScene& scene);

// The colours that the picture uses.
ColorScale FieldScale(const FieldScene& scene);

}  // namespace telestrain::viz
