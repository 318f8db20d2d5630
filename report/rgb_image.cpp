#include "report/rgb_image.h"

#include <png.h>

#include <cstdlib>
#include <cstring>

#include "base/files.h"

namespace telestrain {
namespace {

constexpr int kBytesPerPixel = 3;
constexpr double kMostPixels = 1e8;

// a, b, c: left, above, above left; the predictor of PNG filter type 4.
int Paeth(int a, int b, int c) {
  const int p = a + b - c;
  const int pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
  if (pa <= pb && pa <= pc) return a;
  return pb <= pc ? b : c;
}

int Predict(int filter, int left, int above, int above_left) {
  switch (filter) {
    case 1:
      return left;
    case 2:
      return above;
    case 3:
      return (left + above) / 2;
    case 4:
      return Paeth(left, above, above_left);
    default:
      return 0;
  }
}

// Filters one row into `out`; returns the sum of absolute differences.
long FilterRow(int filter, const unsigned char* row, const unsigned char* above, std::size_t bytes,
               std::string& out) {
  out.assign(1, static_cast<char>(filter));
  long sum = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    const int left = i >= kBytesPerPixel ? row[i - kBytesPerPixel] : 0;
    const int up = above ? above[i] : 0;
    const int up_left = above && i >= kBytesPerPixel ? above[i - kBytesPerPixel] : 0;
    const auto difference = static_cast<signed char>(row[i] - Predict(filter, left, up, up_left));
    sum += std::abs(difference);
    out.push_back(static_cast<char>(difference));
  }
  return sum;
}

}  // namespace

Result<RgbImage> ReadPng(const std::filesystem::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  const auto failed = [&] {
    const std::string reason = png.message;
    png_image_free(&png);
    return BadInput(path.string() + ": is not a readable PNG picture: " + reason +
                    "; make the pictures again with 'telestrain render'");
  };
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) return failed();
  if (double(png.width) * double(png.height) > kMostPixels) {
    png_image_free(&png);
    return BadInput(path.string() + ": has more than 100 megapixels, the most a report takes");
  }
  png.format = PNG_FORMAT_RGB;
  RgbImage image{static_cast<int>(png.width), static_cast<int>(png.height), {}};
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&png, &white, image.pixels.data(), 0, nullptr)) return failed();
  return image;
}

std::string PredictRows(const RgbImage& image) {
  const auto bytes = static_cast<std::size_t>(image.width_px) * kBytesPerPixel;
  std::string all;
  all.reserve((bytes + 1) * static_cast<std::size_t>(image.height_px));
  std::string best, candidate;
  for (int y = 0; y < image.height_px; ++y) {
    const unsigned char* row = image.pixels.data() + bytes * static_cast<std::size_t>(y);
    const unsigned char* above = y > 0 ? row - bytes : nullptr;
    long best_sum = FilterRow(0, row, above, bytes, best);
    for (int filter = 1; filter <= 4; ++filter) {
      const long sum = FilterRow(filter, row, above, bytes, candidate);
      if (sum >= best_sum) continue;
      best_sum = sum;
      best.swap(candidate);
    }
    all += best;
  }
  return all;
}

}  // namespace telestrain
