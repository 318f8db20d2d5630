#pragma once

#include <string>

#include "base/gray_image.h"
#include "base/result.h"

namespace telestrain {

// PNG bytes of an image of whole grey levels; 16 bits when max_gray is above 255. Fails
// (kOutputFailed) on an empty image.
Result<std::string> EncodePng(const GrayImage& image);

}  // namespace telestrain
