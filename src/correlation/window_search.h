#pragma once

#include <Eigen/Core>
#include <complex>
#include <utility>
#include <vector>

#include "base/gray_image.h"
#include "session/session.h"

namespace telestrain::correlation {

// Zero-mean normalised cross-correlation of blocks with every place of one image, by Fourier
// transforms: N log N in the image's pixels, whatever the size of the block. Thread-safe.
class WindowSearch {
 public:
  explicit WindowSearch(const GrayImage& image);

  // For each block, the correlation with its top left pixel at every place where it lies inside the
  // image whole: (width - block width + 1) x (height - block height + 1) values as an image. Zero
  // where the image is nearly flat. Blocks are transformed two at a time.
  std::vector<GrayImage> Correlate(const std::vector<GrayImage>& blocks) const;

 private:
  using Spectrum = std::vector<std::complex<float>>;
  Spectrum Products(const GrayImage& one, const GrayImage* two) const;
  GrayImage Normalise(const GrayImage& block, const Spectrum& products, bool imaginary) const;

  int width_, height_;
  int columns_, rows_;  // of the transform
  Spectrum spectrum_;   // transposed
  // Sums over the rectangle above and left of a pixel, of the values and of their squares.
  std::vector<double> sums_, squares_;
};

// The highest value of a correlation image, and the highest one beyond `apart` pixels from it.
struct CorrelationPeak {
  Eigen::Vector2i at = Eigen::Vector2i::Zero();
  double zncc = 0;
  double margin = 0;  // above the second highest
};
CorrelationPeak FindPeak(const GrayImage& correlation, int apart);

// Mean over squares of `factor` pixels; the rest at the right and the bottom is left out.
GrayImage ReduceByMean(const GrayImage& image, const PixelRegion& region, int factor);

// A square of side `side_px` about `center_px`, turned by `angle_rad` (from x towards y), as an
// image whose content is turned so would show it; linear interpolation. The square's corner must
// stay inside the image.
GrayImage TurnedBlock(const GrayImage& image, const Eigen::Vector2d& center_px, int side_px,
                      double angle_rad);

}  // namespace telestrain::correlation
