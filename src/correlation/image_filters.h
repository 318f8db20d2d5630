#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "base/gray_image.h"
#include "correlation/subset_correlation.h"
#include "session/session.h"

namespace telestrain::correlation {

// The pixels of a region. A region outside the image or below 8 px a side is a broken contract.
GrayImage Crop(const GrayImage& image, const PixelRegion& region);
void CheckRegion(const GrayImage& image, const PixelRegion& region);

// Normalised samples of a Gaussian, 2n+1 of them; {1} when sigma is zero or less.
std::vector<float> GaussianKernel(double sigma_px);

// Blur by a Gaussian and B-spline coefficients in one: the Gaussian's samples convolved with the
// inverse of the spline's, whose poles decay (0.43^k, 0.27^k). Cut where the rest sums to less than
// 1e-7 of the whole; normalised.
std::vector<float> CoefficientKernel(Interpolation interpolation, double sigma_px);
// The slope of the blurred image at whole pixels along one direction, by differences of fourth
// order. They give less weight to detail near two pixels a period than the slope of the spline,
// where the interpolation errs most and the noise outweighs the pattern.
std::vector<float> SlopeKernel(double sigma_px);

// Grey levels in memory: row by row, rows `stride` apart.
struct ImageView {
  const float* pixels;
  std::ptrdiff_t stride;
  int width, height;
};
ImageView View(const GrayImage& image, const PixelRegion& region);

// out(x, y) = sum_jk kernel_y[j] kernel_x[k] in(x + k - n, y + j - m) for a part of the view that
// may reach beyond it, the border mirrored about the outermost pixel centres. Every output is the
// same sum in the same order wherever it lies, for any number of threads. Works in strips of
// columns: no temporary of the size of the image.
void FilterSeparable(const ImageView& view, const std::vector<float>& kernel_x,
                     const std::vector<float>& kernel_y, const PixelRegion& part, int threads,
                     float* out, std::ptrdiff_t out_stride);

// A whole image of at least 8 px a side, on one thread.
GrayImage Filtered(const GrayImage& image, const std::vector<float>& kernel_x,
                   const std::vector<float>& kernel_y);
// Both directions with the same kernel.
GrayImage Blur(const GrayImage& image, const std::vector<float>& kernel);

// Variance of white noise of variance one after a filter: the sum of the squared weights.
double NoiseVarianceAfter(const std::vector<float>& weights);

// A kernel that is not a product of two: (2 reach + 1)^2 weights, row by row.
struct PlaneKernel {
  int reach = 0;
  std::vector<float> weights{1.f};
};

// Gaussian whose samples have the given second moments (px^2), also where it is narrower than a
// pixel.
PlaneKernel GaussianPlaneKernel(const Eigen::Matrix2d& covariance_px2);
GrayImage FilterPlane(const GrayImage& image, const PlaneKernel& kernel);

}  // namespace telestrain::correlation
