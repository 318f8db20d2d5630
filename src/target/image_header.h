#pragma once

#include <optional>
#include <string_view>

namespace telestrain {

struct ImageSize {
  long long width_px = 0, height_px = 0;
};

// The size that a PNG, BMP, PGM/PPM, TIFF or JPEG file states in its header, without decoding it:
// a few bytes can promise an image that would fill the memory. Nothing when the format is another
// one or the header is damaged.
std::optional<ImageSize> SizeFromHeader(std::string_view bytes);

}  // namespace telestrain
