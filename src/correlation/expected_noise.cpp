#include "correlation/expected_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace telestrain {
namespace {

// Fourth-order central difference, as the assessment takes it, and what white noise of variance one
// leaves in its square.
double Slope(double far_below, double below, double above, double far_above) {
  return (far_below - 8 * below + 8 * above - far_above) / 12;
}
constexpr double kSlopeNoise = (1 + 64 + 64 + 1) / 144.0;

// Sums over whole columns of a band of rows, then over all columns to the left: the sum over any
// subset of the band is the difference of two.
class BandSums {
 public:
  BandSums(const GrayImage& image, const PixelMask* mask)
      : image_(image), mask_(mask), until_(static_cast<std::size_t>(image.width) + 1) {}

  void Gather(int first_row, int end_row) {
    std::fill(until_.begin(), until_.end(), std::array<double, 3>{});
    for (int y = std::max(first_row, 2); y < std::min(end_row, image_.height - 2); ++y) AddRow(y);
    for (std::size_t x = 1; x < until_.size(); ++x)
      for (std::size_t part = 0; part < 3; ++part) until_[x][part] += until_[x - 1][part];
  }

  // Squared gradient along x and y, and the number of pixels.
  std::array<double, 3> Between(int first_column, int end_column) const {
    const auto& low = until_[static_cast<std::size_t>(std::max(first_column, 0))];
    const auto& high = until_[static_cast<std::size_t>(std::min(end_column, image_.width))];
    return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  }

 private:
  void AddRow(int y) {
    for (int x = 2; x + 2 < image_.width; ++x) {
      if (mask_ != nullptr && !mask_->At(x, y)) continue;
      const double along =
          Slope(image_.At(x - 2, y), image_.At(x - 1, y), image_.At(x + 1, y), image_.At(x + 2, y));
      const double down =
          Slope(image_.At(x, y - 2), image_.At(x, y - 1), image_.At(x, y + 1), image_.At(x, y + 2));
      auto& sums = until_[static_cast<std::size_t>(x) + 1];
      sums[0] += along * along;
      sums[1] += down * down;
      sums[2] += 1;
    }
  }

  const GrayImage& image_;
  const PixelMask* mask_;
  std::vector<std::array<double, 3>> until_;
};

}  // namespace

std::vector<double> ExpectedSigma_px(const GrayImage& image,
                                     const std::vector<Eigen::Vector2i>& centers_px, int subset_px,
                                     const PatternAssessment& pattern, const PixelMask* mask) {
  std::vector<double> sigma_px;
  sigma_px.reserve(centers_px.size());
  BandSums sums(image, mask);
  const int half = subset_px / 2;
  const double noise = kSlopeNoise * pattern.noise_gray * pattern.noise_gray;
  // Of a subset with an SSSIG of one.
  const double unit_px =
      pattern.expected_sigma_px * pattern.recommended_subset_px * pattern.gradient_gray_per_px;
  int row = std::numeric_limits<int>::min();
  for (const Eigen::Vector2i& center : centers_px) {
    if (center.y() != row) sums.Gather(center.y() - half, center.y() + half + 1);
    row = center.y();
    const auto [along, down, pixels] = sums.Between(center.x() - half, center.x() + half + 1);
    const double sssig = std::min(along, down) - noise * pixels;
    sigma_px.push_back(sssig > 0 ? unit_px / std::sqrt(sssig)
                                 : std::numeric_limits<double>::quiet_NaN());
  }
  return sigma_px;
}

}  // namespace telestrain
