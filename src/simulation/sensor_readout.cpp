#include "simulation/sensor_readout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "simulation/random_stream.h"

namespace telestrain {
namespace {

constexpr int kPngCompression = 3;

// Read noise in levels of the format, so that noise and quantisation add up to `total_levels`.
double ReadNoise(double total_levels) {
  return std::sqrt(std::max(0.0, total_levels * total_levels - 1.0 / 12.0));
}

template <typename Level>
cv::Mat LevelsOf(const GrayImage& image) {
  cv::Mat levels(image.height, image.width, cv::traits::Type<Level>::value);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      levels.at<Level>(y, x) = static_cast<Level>(image.At(x, y));
  return levels;
}

}  // namespace

GrayImage ReadOut(const GrayImage& ideal, double noise_gray, int bit_depth, std::uint64_t key) {
  const double full_scale = bit_depth == 8 ? 255 : 65535;
  const double levels_per_gray = full_scale / 255;
  const double noise = ReadNoise(noise_gray * levels_per_gray);
  GrayImage image = ideal;
  image.max_gray = static_cast<float>(full_scale);
  std::array<double, 2> pair{};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (noise > 0 && i % 2 == 0) pair = NormalPair(key, i / 2);
    const double level = ideal.pixels[i] * levels_per_gray + noise * pair[i % 2];
    image.pixels[i] = static_cast<float>(std::clamp(std::floor(level + 0.5), 0.0, full_scale));
  }
  return image;
}

Result<std::string> EncodePng(const GrayImage& image) {
  try {
    const cv::Mat levels =
        image.max_gray > 255 ? LevelsOf<std::uint16_t>(image) : LevelsOf<std::uint8_t>(image);
    std::vector<std::uint8_t> bytes;
    if (!cv::imencode(".png", levels, bytes, {cv::IMWRITE_PNG_COMPRESSION, kPngCompression}))
      return OutputFailed("PNG encoding failed; OpenCV was built without PNG");
    return std::string(bytes.begin(), bytes.end());
  } catch (const cv::Exception& e) {
    return OutputFailed(std::string("PNG encoding failed: ") + e.what());
  }
}

}  // namespace telestrain
