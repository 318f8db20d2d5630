#include "correlation/image_filters.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "correlation/quintic_spline.h"

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

}  // namespace

GrayImage Crop(const GrayImage& image, const PixelRegion& region) {
  TELESTRAIN_CHECK(region.x >= 0 && region.y >= 0 && region.width >= kSmallestSide_px &&
                       region.height >= kSmallestSide_px &&
                       region.x + region.width <= image.width &&
                       region.y + region.height <= image.height,
                   "the region must lie inside the image and measure at least 8 px");
  GrayImage part{region.width, region.height, image.max_gray, {}};
  part.pixels.reserve(static_cast<std::size_t>(region.width) * region.height);
  for (int y = 0; y < region.height; ++y) {
    const float* row = &image.pixels[static_cast<std::size_t>(region.y + y) * image.width];
    part.pixels.insert(part.pixels.end(), row + region.x, row + region.x + region.width);
  }
  return part;
}

std::vector<float> GaussianKernel(double sigma_px) {
  if (!(sigma_px > 0)) return {1.f};
  const int reach = static_cast<int>(std::ceil(4 * sigma_px));
  std::vector<double> weights;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
    sum += weights.back();
  }
  std::vector<float> kernel;
  for (double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

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

GrayImage FilterColumns(const GrayImage& image, const std::vector<float>& kernel) {
  const int reach = static_cast<int>(kernel.size()) / 2;
  GrayImage out = EmptyLike(image);
  for (int y = 0; y < image.height; ++y) {
    float* row = &out.At(0, y);
    for (int k = -reach; k <= reach; ++k) {
      const float* from =
          &image.pixels[static_cast<std::size_t>(MirroredIndex(y + k, image.height)) * image.width];
      for (int x = 0; x < image.width; ++x) row[x] += kernel[k + reach] * from[x];
    }
  }
  return out;
}

GrayImage Blur(const GrayImage& image, const std::vector<float>& kernel) {
  if (kernel.size() == 1) return image;
  return FilterColumns(FilterRows(image, kernel), kernel);
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
