#include "viz/field_colors.h"

#include <algorithm>
#include <cmath>

namespace telestrain::viz {
namespace {

// How far the texture moves a colour towards white or black. Enough to see the speckles, and the
// steps of the map stay the larger ones.
constexpr double kTexture = 0.3;
constexpr double kFaded = 0.45;  // share of paper white outside the region

Rgb Towards(const Rgb& color, double gray, double share) {
  return {color.r + share * (gray - color.r), color.g + share * (gray - color.g),
          color.b + share * (gray - color.b)};
}

class Painter {
 public:
  Painter(const ImageBackdrop& backdrop, const FieldScene& scene, const ColorMap& colors)
      : backdrop_(backdrop), scene_(scene), colors_(colors), inside_(InsidePixels()) {}

  RgbImage Paint(int edge_px) const {
    RgbImage image;
    image.width_px = backdrop_.width();
    image.height_px = backdrop_.height();
    image.rgb.reserve(3 * inside_.size());
    for (int row = 0; row < image.height_px; ++row)
      for (int column = 0; column < image.width_px; ++column) {
        const auto bytes =
            BytesOf(IsEdge(column, row, edge_px) ? kFieldEdge : ColorAt(column, row));
        image.rgb.insert(image.rgb.end(), bytes.begin(), bytes.end());
      }
    return image;
  }

 private:
  std::vector<bool> InsidePixels() const {
    std::vector<bool> inside;
    inside.reserve(static_cast<std::size_t>(backdrop_.width()) *
                   static_cast<std::size_t>(backdrop_.height()));
    for (int row = 0; row < backdrop_.height(); ++row)
      for (int column = 0; column < backdrop_.width(); ++column) {
        const Eigen::Vector2d place = backdrop_.ImagePlace(column, row);
        const int x =
            std::clamp(static_cast<int>(std::lround(place.x())), 0, backdrop_.image_width_px() - 1);
        const int y = std::clamp(static_cast<int>(std::lround(place.y())), 0,
                                 backdrop_.image_height_px() - 1);
        inside.push_back(!scene_.inside || scene_.inside(x, y));
      }
    return inside;
  }

  bool Inside(int column, int row) const {
    return inside_[static_cast<std::size_t>(row) * static_cast<std::size_t>(backdrop_.width()) +
                   static_cast<std::size_t>(column)];
  }

  // A pixel outside the region within `edge_px` of it: the line hides nothing of the field.
  bool IsEdge(int column, int row, int edge_px) const {
    if (Inside(column, row)) return false;
    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const int c = std::clamp(column + edge_px * dx, 0, backdrop_.width() - 1);
      const int r = std::clamp(row + edge_px * dy, 0, backdrop_.height() - 1);
      if (Inside(c, r)) return true;
    }
    return false;
  }

  Rgb ColorAt(int column, int row) const {
    const double gray = backdrop_.Gray(column, row);
    if (!Inside(column, row)) return Towards({gray, gray, gray}, 1, kFaded);
    const double value = ValueAt(backdrop_.ImagePlace(column, row));
    if (!std::isfinite(value)) return {gray, gray, gray};
    const double contrast = gray - backdrop_.mean_gray();
    return Towards(colors_.At(value), contrast > 0 ? 1 : 0, kTexture * std::abs(contrast));
  }

  double Sample(int column, int row) const {
    if (column < 0 || row < 0 || column >= scene_.columns || row >= scene_.rows)
      return std::numeric_limits<double>::quiet_NaN();
    return scene_
        .samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(scene_.columns) +
                 static_cast<std::size_t>(column)]
        .value;
  }

  double ValueAt(const Eigen::Vector2d& place_px) const {
    if (scene_.samples.empty()) return std::numeric_limits<double>::quiet_NaN();
    const Eigen::Vector2d at = (place_px - scene_.samples.front().at_px) / scene_.step_px;
    const int left = static_cast<int>(std::floor(at.x())),
              top = static_cast<int>(std::floor(at.y()));
    const double x = at.x() - left, y = at.y() - top;
    const double between = (1 - y) * ((1 - x) * Sample(left, top) + x * Sample(left + 1, top)) +
                           y * ((1 - x) * Sample(left, top + 1) + x * Sample(left + 1, top + 1));
    if (std::isfinite(between)) return between;
    return Sample(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())));
  }

  const ImageBackdrop& backdrop_;
  const FieldScene& scene_;
  const ColorMap& colors_;
  std::vector<bool> inside_;
};

}  // namespace

RgbImage ColoredBackdrop(const ImageBackdrop& backdrop, const FieldScene& scene,
                         const ColorMap& colors, int edge_px) {
  return Painter(backdrop, scene, colors).Paint(edge_px);
}

}  // namespace telestrain::viz
