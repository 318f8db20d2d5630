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
  const int pa = std::abs(b - c), pb = std::abs(a - c), pc = std::abs(a + b - 2 * c);
  const int other = pb <= pc ? b : c;
  return pa <= pb && pa <= pc ? a : other;
}

// A row with a pixel of zeros before it, so that the first pixel has a left neighbour too.
using PaddedRow = std::vector<unsigned char>;

// Filters one row into `out`, behind its filter byte; returns the sum of absolute differences.
// `predict` takes left, above and above left. One loop without branches per filter: the compiler
// makes vectors of them, and half the time of a picture goes here.
template <class Predictor>
int FilterRow(int filter, const PaddedRow& row, const PaddedRow& above, Predictor predict,
              std::string& out) {
  out.resize(row.size() - kBytesPerPixel + 1);
  out[0] = static_cast<char>(filter);
  const unsigned char* here = row.data() + kBytesPerPixel;
  const unsigned char* left = row.data();
  const unsigned char* up = above.data() + kBytesPerPixel;
  const unsigned char* up_left = above.data();
  char* differences = out.data() + 1;
  int sum = 0;
  for (std::size_t i = 0; i < row.size() - kBytesPerPixel; ++i) {
    const int predicted = predict(left[i], up[i], up_left[i]);
    const auto difference = static_cast<signed char>(here[i] - predicted);
    differences[i] = static_cast<char>(difference);
    sum += difference < 0 ? -difference : difference;
  }
  return sum;
}

int FilterRow(int filter, const PaddedRow& row, const PaddedRow& above, std::string& out) {
  switch (filter) {
    case 1:
      return FilterRow(
          1, row, above, [](int left, int, int) { return left; }, out);
    case 2:
      return FilterRow(
          2, row, above, [](int, int up, int) { return up; }, out);
    case 3:
      return FilterRow(
          3, row, above, [](int left, int up, int) { return (left + up) / 2; }, out);
    case 4:
      return FilterRow(4, row, above, Paeth, out);
    default:
      return FilterRow(
          0, row, above, [](int, int, int) { return 0; }, out);
  }
}

}  // namespace

Result<RgbImage> ReadPng(const std::filesystem::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMostImageBytes));
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
  PaddedRow row(bytes + kBytesPerPixel), above(bytes + kBytesPerPixel);
  for (int y = 0; y < image.height_px; ++y) {
    row.swap(above);
    std::memcpy(row.data() + kBytesPerPixel,
                image.pixels.data() + bytes * static_cast<std::size_t>(y), bytes);
    int best_sum = FilterRow(0, row, above, best);
    for (int filter = 1; filter <= 4; ++filter) {
      const int sum = FilterRow(filter, row, above, candidate);
      if (sum >= best_sum) continue;
      best_sum = sum;
      best.swap(candidate);
    }
    all += best;
  }
  return all;
}

}  // namespace telestrain
