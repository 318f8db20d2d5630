#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

namespace telestrain {

// Pixels as an image file holds them. Private to the module.
struct DecodedPixels {
  cv::Mat pixels;  // 8- or 16-bit, one channel of grey or three of blue, green, red; else empty
  std::string failure;  // why there are none: what the decoder found and at which byte
};

// Decode a whole image, by libpng, libjpeg and OpenCV. The size that the header states is believed:
// check it before (image_header.h). Damage of the pixels is a failure, where other readers warn and
// fill the rest with grey; that of remarks beside them, or behind the image, is none. Transparency
// is left out; the EXIF orientation is not followed, pixels stand as the sensor gave them. Nothing
// is written to stderr. Thread-safe.
DecodedPixels DecodePng(std::string_view bytes);
DecodedPixels DecodeJpeg(std::string_view bytes);
DecodedPixels DecodeOther(std::string_view bytes);  // TIFF, BMP and PNM

}  // namespace telestrain
