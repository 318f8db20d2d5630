#pragma once

#include <string>

#include "base/result.h"
#include "viz/pictures.h"

namespace telestrain::viz {

// The picture as a PNG file with the pHYs chunk for its resolution. The same picture gives the same
// bytes. Fails (kOutputFailed) when the encoder does.
Result<std::string> PngBytes(const RgbImage& image);

}  // namespace telestrain::viz
