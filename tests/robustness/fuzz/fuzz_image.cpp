#include <algorithm>
#include <cmath>

#include "report/rgb_image.h"
#include "robustness/fuzz/fuzz_target.h"
#include "target/image_file.h"
#include "target/image_header.h"

namespace telestrain::fuzz {
namespace {

// What a file may promise to be decoded here; the program's own limit is fifty times as much.
constexpr long long kMostPixels = 2'000'000;

void CheckPixels(const GrayImage& image) {
  Require(image.pixels.size() ==
              static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
          "an image has all of its pixels");
  const bool in_range = std::all_of(image.pixels.begin(), image.pixels.end(), [&](float gray) {
    return gray >= 0 && gray <= image.max_gray;
  });
  Require(in_range, "grey levels lie between 0 and full scale");
}

}  // namespace

void FuzzImage(std::string_view input) {
  static MemoryFolder folder("image_");
  const std::string bytes(input);
  Succeeds(CheckImageBytes("image", bytes));
  Succeeds(CheckImageBytes("image", bytes, 64, 48));
  const auto size = SizeFromHeader(bytes);
  const bool is_small = !size || size->width_px <= kMostPixels / size->height_px;
  if (!is_small) return;
  const auto image = DecodeGrayImage("image", bytes);
  if (Succeeds(image)) {
    CheckPixels(*image);
    Require(size && size->width_px == image->width && size->height_px == image->height,
            "an image has the size that its header states");
  }
  folder.Hold({{"image.png", bytes}}, {"image.png"});
  const auto color = ReadPng(folder.path() / "image.png");
  if (Succeeds(color))
    Require(PredictRows(*color).size() == static_cast<std::size_t>(color->height_px) *
                                              (3 * static_cast<std::size_t>(color->width_px) + 1),
            "a row for PDF has a filter byte and its pixels");
}

}  // namespace telestrain::fuzz
