#pragma once

#include <cstdint>
#include <string>

#include "base/gray_image.h"
#include "base/result.h"

namespace telestrain {

// Turns an ideal image (8-bit scale) into what the sensor delivers: read noise, whole grey levels
// of `bit_depth` bits, clipped. `noise_gray` is the standard deviation of both together on the
// 8-bit scale; a value below quantisation's own 0.29 gives quantisation alone. Every pixel's noise
// follows from `key` and its place.
GrayImage ReadOut(const GrayImage& ideal, double noise_gray, int bit_depth, std::uint64_t key);

// PNG bytes of an image of whole grey levels; 16 bits when max_gray is above 255.
Result<std::string> EncodePng(const GrayImage& image);

}  // namespace telestrain
