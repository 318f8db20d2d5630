#include "report/picture_block.h"

#include <algorithm>
#include <utility>

namespace telestrain {

void DrawCaption(PageFlow& flow, const std::string& caption) {
  flow.Advance(4);
  if (!caption.empty()) flow.Paragraph(flow.look().Note(), caption);
  flow.Advance(10);
}

double CaptionHeight_pt(PageFlow& flow, const std::string& caption) {
  return 14 + flow.TextHeight_pt(flow.look().Note(), flow.width_pt(), caption);
}

void DrawPictureBlock(PageFlow& flow, RgbImage image, double pixel_pt, const std::string& caption,
                      const std::string& words) {
  const double caption_pt = CaptionHeight_pt(flow, caption);
  double width_pt = image.width_px * pixel_pt, height_pt = image.height_px * pixel_pt;
  // A picture that is too large keeps its shape and gets more pixels an inch. The millipoint admits
  // 2008 px at 300 dpi, which is 0.01 mm more than 170 mm.
  const double fit = std::min(
      {1.0, (flow.width_pt() + 0.1) / width_pt, (flow.PageBody_pt() - caption_pt) / height_pt});
  width_pt *= fit;
  height_pt *= fit;
  flow.Require(height_pt + caption_pt);
  const double left_pt = flow.left_pt() + (flow.width_pt() - width_pt) / 2;
  const PageBox box{left_pt, flow.y_pt() - height_pt, width_pt, height_pt};
  {
    const ScopedTag figure(flow.pdf(), PdfTag{"Figure", words, "", box});
    flow.pdf().DrawImage(std::move(image), box);
  }
  flow.Advance(height_pt);
  DrawCaption(flow, caption);
}

}  // namespace telestrain
