#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

// 8-bit RGB pixels, row by row from the top left, three bytes each.
struct RgbImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<unsigned char> pixels;
};

// Decodes a PNG of any type; transparent parts are shown on white. Fails (kBadInput) with the path
// and libpng's reason when the file is missing, damaged or larger than 100 megapixels.
Result<RgbImage> ReadPng(const std::filesystem::path& path);

// The rows as the PNG predictors of PDF (Predictor 15) want them: one filter byte and the filtered
// row each, the filter chosen per row by the smallest sum of absolute differences (PNG 12.8).
std::string PredictRows(const RgbImage& image);

}  // namespace telestrain
