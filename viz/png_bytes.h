#pragma once

#include <string>

#include "base/result.h"
#include "viz/pictures.h"

namespace telestrain::viz {

// The picture as a PNG file, RGB or RGBA, with the pHYs chunk for its resolution. The same picture
// gives the same bytes. Thread-safe. Fails (kOutputFailed) when the encoder does.
Result<std::string> PngBytes(const RgbImage& image);

}  // namespace telestrain::viz
