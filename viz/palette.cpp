#include "viz/palette.h"

#include <algorithm>

namespace telestrain::viz {
namespace {

constexpr std::size_t kBins = 32 * 32 * 32;

// Pixels whose channels agree in their upper five bits.
struct Bin {
  std::size_t count = 0;
  std::array<std::size_t, 3> sum{};
};

std::size_t BinOf(const std::uint8_t* rgb) {
  return (static_cast<std::size_t>(rgb[0]) >> 3) << 10 |
         (static_cast<std::size_t>(rgb[1]) >> 3) << 5 | static_cast<std::size_t>(rgb[2]) >> 3;
}
bool IsWhite(const std::uint8_t* rgb) { return rgb[0] == 255 && rgb[1] == 255 && rgb[2] == 255; }
int LevelOf(std::size_t bin, std::size_t channel) {
  return static_cast<int>(bin >> (10 - 5 * channel) & 31);
}

// Bins that become one colour.
struct Box {
  std::vector<std::size_t> bins;
  std::size_t count = 0;
  std::size_t widest = 0;  // channel
  int width = 0;           // of that channel, in levels

  // How much a cut would help.
  double Spread() const { return static_cast<double>(count) * width * width; }
};

Box BoxOf(std::vector<std::size_t> bins, const std::vector<Bin>& histogram) {
  Box box{std::move(bins)};
  for (const std::size_t bin : box.bins) box.count += histogram[bin].count;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto [low, high] = std::minmax_element(
        box.bins.begin(), box.bins.end(),
        [&](std::size_t a, std::size_t b) { return LevelOf(a, channel) < LevelOf(b, channel); });
    const int width = LevelOf(*high, channel) - LevelOf(*low, channel);
    if (width > box.width) {
      box.width = width;
      box.widest = channel;
    }
  }
  return box;
}

// At the median of the widest channel; both parts hold something.
std::array<Box, 2> Cut(Box box, const std::vector<Bin>& histogram) {
  std::stable_sort(box.bins.begin(), box.bins.end(), [&](std::size_t a, std::size_t b) {
    return LevelOf(a, box.widest) < LevelOf(b, box.widest);
  });
  std::size_t below = histogram[box.bins.front()].count, split = 1;
  while (split + 1 < box.bins.size() && 2 * below < box.count)
    below += histogram[box.bins[split++]].count;
  const auto middle = box.bins.begin() + static_cast<std::ptrdiff_t>(split);
  return {BoxOf({box.bins.begin(), middle}, histogram), BoxOf({middle, box.bins.end()}, histogram)};
}

std::vector<Box> CutInto(std::size_t most, const std::vector<Bin>& histogram) {
  std::vector<std::size_t> used;
  for (std::size_t bin = 0; bin < kBins; ++bin)
    if (histogram[bin].count > 0) used.push_back(bin);
  std::vector<Box> boxes;
  if (used.empty()) return boxes;
  boxes.push_back(BoxOf(std::move(used), histogram));
  while (boxes.size() < most) {
    const auto worst = std::max_element(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
      return a.Spread() < b.Spread();
    });
    if (worst->width == 0) break;
    auto [left, right] = Cut(std::move(*worst), histogram);
    *worst = std::move(left);
    boxes.push_back(std::move(right));
  }
  return boxes;
}

}  // namespace

IndexedImage Indexed(const RgbImage& image, std::size_t most_colors) {
  const std::size_t pixels = image.rgb.size() / 3;
  std::vector<Bin> histogram(kBins);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t* rgb = &image.rgb[3 * i];
    if (IsWhite(rgb)) continue;
    Bin& bin = histogram[BinOf(rgb)];
    ++bin.count;
    for (std::size_t c = 0; c < 3; ++c) bin.sum[c] += rgb[c];
  }
  IndexedImage indexed{{{255, 255, 255}}, std::vector<std::uint8_t>(pixels, 0)};
  std::vector<std::uint8_t> color_of(kBins, 0);
  for (const Box& box : CutInto(most_colors - 1, histogram)) {
    std::array<std::size_t, 3> sum{};
    for (const std::size_t bin : box.bins) {
      color_of[bin] = static_cast<std::uint8_t>(indexed.colors.size());
      for (std::size_t c = 0; c < 3; ++c) sum[c] += histogram[bin].sum[c];
    }
    std::array<std::uint8_t, 3> mean{};
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] = static_cast<std::uint8_t>((sum[c] + box.count / 2) / box.count);
    indexed.colors.push_back(mean);
  }
  for (std::size_t i = 0; i < pixels; ++i)
    if (!IsWhite(&image.rgb[3 * i])) indexed.indices[i] = color_of[BinOf(&image.rgb[3 * i])];
  return indexed;
}

}  // namespace telestrain::viz
