#pragma once

#include <string>

#include "report/page_flow.h"
#include "report/rgb_image.h"

namespace telestrain {

// A note below a picture or a chart, with its distance to what follows; empty text: the distance.
void DrawCaption(PageFlow& flow, const std::string& caption);
double CaptionHeight_pt(PageFlow& flow, const std::string& caption);

// A picture in the middle of the column, `pixel_pt` a pixel or smaller where it is too large for
// the page, with its caption on the same page. `words` says what it shows to who cannot see it.
void DrawPictureBlock(PageFlow& flow, RgbImage image, double pixel_pt, const std::string& caption,
                      const std::string& words);

}  // namespace telestrain
