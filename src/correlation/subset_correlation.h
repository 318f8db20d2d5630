#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/gray_image.h"
#include "correlation/pixel_mask.h"
#include "session/session.h"

namespace telestrain {

enum class Interpolation { kCubic, kQuintic };  // degree of the B-spline: 3 is faster, 5 truer

struct CorrelationOptions {
  int subset_px = 61;   // odd side of the square subset
  int shape_order = 1;  // 0: shift, 1: affine, 2: quadratic shape function
  Interpolation interpolation = Interpolation::kQuintic;
  // Gaussian blur of both images: removes interpolation bias and costs noise. The least that keeps
  // the bias below 0.2 mpx on discs of paint with edges of 0.7 px (measured with 33 px: 0.52, 0.28,
  // 0.17, 0.11 mpx at 0, 0.5, 0.6, 0.7 px; the noise there is 5 % above the limit, 8 % at 0.7 px).
  double prefilter_sigma_px = 0.6;
  int max_iterations = 30;
  // On the step of one iteration: the root of the summed squares of its parameters, those of
  // gradients and curvatures as they move the end of a half side.
  double convergence_px = 1e-4;
  double min_zncc = 0.5;           // below it a match is reported as decorrelated
  double min_contrast_gray = 2.0;  // rms grey level of a subset that can be correlated
  int threads = 0;                 // 0: one per core
};

// Shape function: the pixel at offset d = (x, y) from the subset's centre c is found at
// c + d + displacement_px + gradient d + curvature_per_px (x^2 / 2, x y, y^2 / 2).
struct ShapeFunction {
  Eigen::Vector2d displacement_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();  // [du/dx du/dy; dv/dx dv/dy]
  // [u_xx u_xy u_yy; v_xx v_xy v_yy], zero below order 2
  Eigen::Matrix<double, 2, 3> curvature_per_px = Eigen::Matrix<double, 2, 3>::Zero();
};

enum class MatchStatus {
  kConverged,
  kLowContrast,
  kOutside,
  kNotConverged,
  kLowCorrelation,
  kSaturated,  // more than half of the pixels at one end of the grey scale, in either image
  kMasked      // less than half of the subset's pixels are inside the mask
};
std::string ToText(MatchStatus status);

struct SubsetMatch {
  MatchStatus status = MatchStatus::kNotConverged;
  ShapeFunction shape;
  double zncc = 0;  // zero-mean normalised cross-correlation at the end
  // Noise (and misfit) of one image before the blur, from the residual. Low by 4 % with a prefilter
  // of 0.5 px and more below: the interpolation itself smooths the noise.
  double sigma_gray = 0;
  // Of (u, v, du/dx, du/dy, dv/dx, dv/dy), from the Hessian and the measured noise, which the blur
  // correlates between pixels.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  int iterations = 0;
  // Sum of the squared grey gradients along x and y (gray^2) over the subset of the reference.
  Eigen::Vector2d sssig = Eigen::Vector2d::Zero();
  bool ok() const { return status == MatchStatus::kConverged; }
};

namespace correlation {
class NoiseShares;
class PixelBits;
struct Saturation;
}  // namespace correlation

// A region of an image, blurred and turned into B-spline coefficients. Copyable; holds one float
// and less than a bit of a pixel. Pixel coordinates are those of the whole image. `gradient` is how
// much the image is stretched against the reference on the whole (another view of the same
// surface): the blur is stretched with it, so that both images lose the same detail of the surface.
// The coefficients of a pixel depend on the 23 pixels around it: a part of an image prepared with
// that margin has the same bits as the whole.
class PreparedImage {
 public:
  PreparedImage(const GrayImage& image, const PixelRegion& region,
                const CorrelationOptions& options,
                const Eigen::Matrix2d& gradient = Eigen::Matrix2d::Zero());
  const PixelRegion& region() const { return region_; }
  // Interpolated (blurred) grey level; the position must be at least 3 px inside the region.
  float Sample(double x_px, double y_px) const;
  // Bytes held beside the image.
  std::size_t bytes() const;

 private:
  friend class CorrelationReference;
  PixelRegion region_;
  Interpolation interpolation_;
  int stride_ = 0;
  std::vector<float> coefficients_;
  double blurred_noise_variance_ = 1;  // of the blurred image, when that of the image is one
  std::shared_ptr<const correlation::Saturation> saturation_;
};

// The reference state: grey levels and gradients of the blurred image at whole pixels.
class CorrelationReference {
 public:
  // Pixels outside the mask (of the size of the image, else a broken contract) never count in any
  // sum over a subset. The blur and the gradients of pixels at its edge still see their neighbours.
  CorrelationReference(const GrayImage& image, const PixelRegion& region,
                       const CorrelationOptions& options, const PixelMask* mask = nullptr);
  const PixelRegion& region() const { return region_; }
  const CorrelationOptions& options() const { return options_; }
  // The region's grey levels after the blur.
  GrayImage BlurredImage() const;

  // Inverse-compositional Gauss-Newton on the zero-mean normalised sum of squared differences from
  // `start` (MODEL: correlation.md of the design, Pan et al. 2013). Thread-safe. The rows of a
  // large subset are shared by `threads` threads (0: one per core), which changes no bit of the
  // result.
  SubsetMatch Match(const Eigen::Vector2i& center_px, const PreparedImage& image,
                    const ShapeFunction& start, int threads = 1) const;

 private:
  // `subset` counts from the region.
  std::optional<MatchStatus> WhyUnusable(const PixelRegion& subset) const;

  PixelRegion region_;
  CorrelationOptions options_;
  std::vector<float> gray_, gradient_x_, gradient_y_;
  double blurred_noise_variance_ = 1;
  std::shared_ptr<const correlation::Saturation> saturation_;
  std::shared_ptr<const correlation::NoiseShares> noise_shares_;
  std::shared_ptr<const correlation::PixelBits> inside_;  // null: all pixels count
};

// Whole-pixel shift of the content of `region` from `reference` to `image` by an exhaustive search
// over +-max_shift_px on reduced images, refined at full resolution; the best of several blocks.
struct ShiftSearch {
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  double zncc = 0;
};
ShiftSearch SearchShift(const GrayImage& reference, const GrayImage& image,
                        const PixelRegion& region, int max_shift_px);

// Tracks every centre from the reference to `image`: `starts` has one entry per centre (or a single
// one for all); a point that fails is tried again from its converged neighbours. One result per
// centre, in order, identical for any number of threads.
std::vector<SubsetMatch> CorrelatePoints(const CorrelationReference& reference,
                                         const std::vector<Eigen::Vector2i>& centers_px,
                                         const PreparedImage& image,
                                         const std::vector<ShapeFunction>& starts);

}  // namespace telestrain
