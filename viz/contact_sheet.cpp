#include <algorithm>
#include <cmath>

#include "viz/legend.h"
#include "viz/pictures.h"
#include "viz/scaled_image.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

constexpr double kMargin_pt = 6, kCaption_pt = 11, kGap_pt = 5;

// Columns and rows of equal cells that show the pictures largest.
struct Grid {
  int columns = 1, rows = 1;
  double scale = 0;  // of the pictures
};

Grid BestGrid(const std::vector<NamedImage>& images, const PixelBox& box, double caption_px,
              double gap_px) {
  Grid best;
  const auto count = static_cast<int>(images.size());
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const double width = (box.width - (columns - 1) * gap_px) / columns;
    const double height = (box.height - (rows - 1) * gap_px) / rows - caption_px;
    double scale = 1;
    for (const NamedImage& named : images)
      scale = std::min({scale, width / named.image->width_px, height / named.image->height_px});
    if (scale > best.scale) best = {columns, rows, scale};
  }
  return best;
}

}  // namespace

Result<Picture> DrawContactSheet(const std::vector<NamedImage>& images, const std::string& facts,
                                 const RenderOptions& options) {
  TELESTRAIN_CHECK(!images.empty(), "a contact sheet needs pictures");
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const double top = AddTitle(canvas.get(), "All pictures", facts);
  const double margin = canvas->Px(kMargin_pt), gap = canvas->Px(kGap_pt);
  const double caption = canvas->Px(kCaption_pt);
  const PixelBox box{margin, margin, canvas->Width() - 2 * margin, top - 2 * margin};
  const Grid grid = BestGrid(images, box, caption, gap);
  if (grid.scale <= 0)
    return OutputFailed("pictures: " + std::to_string(images.size()) +
                        " pictures do not fit on the contact sheet; render a larger picture");
  const double cell_width = (box.width + gap) / grid.columns,
               cell_height = (box.height + gap) / grid.rows;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const RgbImage small = Reduced(
        *images[i].image, std::max(1, static_cast<int>(grid.scale * images[i].image->width_px)),
        std::max(1, static_cast<int>(grid.scale * images[i].image->height_px)));
    const double left =
        box.left + static_cast<double>(i % static_cast<std::size_t>(grid.columns)) * cell_width;
    const double upper =
        box.Top() - static_cast<double>(i / static_cast<std::size_t>(grid.columns)) * cell_height;
    canvas->AddText(images[i].name, {left, upper - caption + canvas->Px(2)}, {7, true, kInk});
    const PixelBox place{std::round(left), std::round(upper - caption - small.height_px),
                         double(small.width_px), double(small.height_px)};
    canvas->AddImage(small, {place.left, place.bottom});
    canvas->Shapes().AddFrame(place.Grown(1), kRejectedColor, 1);
  }
  return canvas->Finish();
}

}  // namespace telestrain::viz
