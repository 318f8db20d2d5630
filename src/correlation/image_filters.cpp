#include "correlation/image_filters.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/parallel.h"
#include "correlation/kernels.h"
#include "correlation/spline.h"

namespace telestrain::correlation {
namespace {

constexpr int kSmallestSide_px = 8;
constexpr int kMomentSteps = 50;

// Samples of exp(-d^T covariance^-1 d / 2), normalised.
std::vector<double> SampleGaussian(const Eigen::Matrix2d& covariance_px2, int reach) {
  const Eigen::Matrix2d inverse = covariance_px2.inverse();
  std::vector<double> weights;
  double sum = 0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2d d(x, y);
      weights.push_back(std::exp(-0.5 * d.dot(inverse * d)));
      sum += weights.back();
    }
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

Eigen::Matrix2d SecondMoments(const std::vector<double>& weights, int reach) {
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  auto weight = weights.begin();
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      moments += *weight++ * Eigen::Vector2d(x, y) * Eigen::RowVector2d(x, y);
  return moments;
}

GrayImage EmptyLike(const GrayImage& image) {
  return {image.width, image.height, image.max_gray, std::vector<float>(image.pixels.size(), 0.f)};
}

std::vector<double> Gaussian(double sigma_px) {
  if (!(sigma_px > 0)) return {1.};
  const int reach = static_cast<int>(std::ceil(4 * sigma_px));
  std::vector<double> weights;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<double> Convolve(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> product(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) product[i + k] += a[i] * b[k];
  return product;
}

// Poles inside the unit circle of z^2 + 4 z + 1 and of z^4 + 26 z^3 + 66 z^2 + 26 z + 1.
std::vector<double> Poles(Interpolation interpolation) {
  if (interpolation == Interpolation::kCubic) return {-0.26794919243112270647};
  return {-0.430575347099973791851434783493, -0.0430962882032646538075920};
}

// The inverse of the spline's samples: for every pole z the filter z^|k| (1 - z) / (1 + z), whose
// weights sum to one.
std::vector<double> InverseSpline(Interpolation interpolation) {
  constexpr int kReach = 40;  // 0.43^40 is below a double's resolution
  std::vector<double> inverse{1.};
  for (double pole : Poles(interpolation)) {
    std::vector<double> filter;
    for (int k = -kReach; k <= kReach; ++k)
      filter.push_back(std::pow(pole, std::abs(k)) * (1 - pole) / (1 + pole));
    inverse = Convolve(inverse, filter);
  }
  return inverse;
}

std::vector<double> Trimmed(const std::vector<double>& kernel) {
  constexpr double kNegligible = 1e-7;
  double whole = 0, rest = 0;
  for (double weight : kernel) whole += std::abs(weight);
  std::ptrdiff_t cut = 0;
  while (rest += 2 * std::abs(kernel[cut]), rest < kNegligible * whole) ++cut;
  return {kernel.begin() + cut, kernel.end() - cut};
}

// What cutting and rounding took from the sum of the weights goes to the middle one.
std::vector<float> ToFloat(const std::vector<double>& kernel, double sum) {
  std::vector<float> weights(kernel.begin(), kernel.end());
  double missing = sum;
  for (float weight : weights) missing -= weight;
  if (sum != 0) weights[weights.size() / 2] += static_cast<float>(missing);
  return weights;
}

// out(x) = sum_k kernel[k] in(x + k - n) along the rows.
GrayImage FilterRows(const GrayImage& image, const std::vector<float>& kernel) {
  const int reach = static_cast<int>(kernel.size()) / 2;
  GrayImage out = EmptyLike(image);
  std::vector<float> padded(static_cast<std::size_t>(image.width + 2 * reach));
  for (int y = 0; y < image.height; ++y) {
    for (int x = -reach; x < image.width + reach; ++x)
      padded[x + reach] = image.At(MirroredIndex(x, image.width), y);
    float* row = &out.At(0, y);
    for (std::size_t k = 0; k < kernel.size(); ++k)
      for (int x = 0; x < image.width; ++x) row[x] += kernel[k] * padded[x + k];
  }
  return out;
}

}  // namespace

void CheckRegion(const GrayImage& image, const PixelRegion& region) {
  TELESTRAIN_CHECK(region.x >= 0 && region.y >= 0 && region.width >= kSmallestSide_px &&
                       region.height >= kSmallestSide_px &&
                       region.x + region.width <= image.width &&
                       region.y + region.height <= image.height,
                   "the region must lie inside the image and measure at least 8 px");
}

GrayImage Crop(const GrayImage& image, const PixelRegion& region) {
  CheckRegion(image, region);
  GrayImage part{region.width, region.height, image.max_gray, {}};
  part.pixels.reserve(static_cast<std::size_t>(region.width) * region.height);
  for (int y = 0; y < region.height; ++y) {
    const float* row = &image.pixels[static_cast<std::size_t>(region.y + y) * image.width];
    part.pixels.insert(part.pixels.end(), row + region.x, row + region.x + region.width);
  }
  return part;
}

std::vector<float> GaussianKernel(double sigma_px) { return ToFloat(Gaussian(sigma_px), 1); }

std::vector<float> CoefficientKernel(Interpolation interpolation, double sigma_px) {
  std::vector<double> kernel = Convolve(InverseSpline(interpolation), Gaussian(sigma_px));
  return ToFloat(Trimmed(kernel), 1);
}

std::vector<float> SlopeKernel(double sigma_px) {
  const std::vector<double> slopes{1. / 12, -8. / 12, 0, 8. / 12, -1. / 12};
  return ToFloat(Convolve(Gaussian(sigma_px), slopes), 0);
}

ImageView View(const GrayImage& image, const PixelRegion& region) {
  CheckRegion(image, region);
  return {image.pixels.data() + static_cast<std::ptrdiff_t>(region.y) * image.width + region.x,
          image.width, region.width, region.height};
}

void FilterSeparable(const ImageView& view, const std::vector<float>& kernel_x,
                     const std::vector<float>& kernel_y, const PixelRegion& part, int threads,
                     float* out, std::ptrdiff_t out_stride) {
  const int reach_x = static_cast<int>(kernel_x.size()) / 2;
  const int reach_y = static_cast<int>(kernel_y.size()) / 2;
  TELESTRAIN_CHECK(std::max(reach_x, reach_y) <= kLargestReach,
                   "a filter must not be longer than 81 px: the prefilter's sigma is at most 5 px");
  const int strips = (part.width + kStripColumns - 1) / kStripColumns;
  ParallelFor(strips, threads, [&](int strip) {
    const int first = strip * kStripColumns;
    ActiveKernels().filter({view.pixels, view.stride, view.width, view.height, kernel_x.data(),
                            kernel_y.data(), reach_x, reach_y, part.x + first,
                            std::min(kStripColumns, part.width - first), part.y,
                            part.y + part.height, out + first, out_stride});
  });
}

GrayImage Filtered(const GrayImage& image, const std::vector<float>& kernel_x,
                   const std::vector<float>& kernel_y) {
  GrayImage out = EmptyLike(image);
  const PixelRegion whole{0, 0, image.width, image.height};
  FilterSeparable(View(image, whole), kernel_x, kernel_y, whole, 1, out.pixels.data(), image.width);
  return out;
}

GrayImage Blur(const GrayImage& image, const std::vector<float>& kernel) {
  return kernel.size() == 1 ? image : Filtered(image, kernel, kernel);
}

double NoiseVarianceAfter(const std::vector<float>& weights) {
  double sum = 0;
  for (double weight : weights) sum += weight * weight;
  return sum;
}

PlaneKernel GaussianPlaneKernel(const Eigen::Matrix2d& covariance_px2) {
  PlaneKernel kernel;
  kernel.reach = static_cast<int>(std::ceil(4 * std::sqrt(covariance_px2.trace())));
  Eigen::Matrix2d sampled = covariance_px2;
  for (int step = 0; step < kMomentSteps; ++step) {
    const Eigen::Matrix2d moments =
        SecondMoments(SampleGaussian(sampled, kernel.reach), kernel.reach);
    sampled += 0.5 * (covariance_px2 - moments);
  }
  kernel.weights.clear();
  for (double weight : SampleGaussian(sampled, kernel.reach))
    kernel.weights.push_back(static_cast<float>(weight));
  return kernel;
}

GrayImage FilterPlane(const GrayImage& image, const PlaneKernel& kernel) {
  const int side = 2 * kernel.reach + 1;
  GrayImage out = EmptyLike(image);
  for (int row = 0; row < side; ++row) {
    GrayImage moved = EmptyLike(image);  // the rows that this row of the kernel meets
    for (int y = 0; y < image.height; ++y) {
      const int from = MirroredIndex(y + row - kernel.reach, image.height);
      std::copy_n(&image.pixels[static_cast<std::size_t>(from) * image.width], image.width,
                  &moved.At(0, y));
    }
    const auto first = kernel.weights.begin() + row * side;
    const GrayImage part = FilterRows(moved, {first, first + side});
    for (std::size_t k = 0; k < part.pixels.size(); ++k) out.pixels[k] += part.pixels[k];
  }
  return out;
}

}  // namespace telestrain::correlation
