#include <cmath>

#include "base/check.h"
#include "correlation/image_filters.h"
#include "correlation/saturation.h"
#include "correlation/spline.h"
#include "correlation/subset_correlation.h"

namespace telestrain {

using namespace correlation;

namespace {

template <int kDegree>
float SampleSpline(const float* middle, std::ptrdiff_t stride, float x, float y) {
  const auto fma = [](float a, float b, float c) { return a * b + c; };
  const auto spread = [](float value) { return value; };
  float weight_x[kDegree + 1], weight_y[kDegree + 1];
  SplineWeights<kDegree>(x, fma, spread, weight_x);
  SplineWeights<kDegree>(y, fma, spread, weight_y);
  const float* first = middle - kDegree / 2 * (stride + 1);
  float sum = 0;
  for (int k = 0; k <= kDegree; ++k) {
    float along = 0;
    for (int j = 0; j <= kDegree; ++j) along += weight_y[j] * first[j * stride + k];
    sum += along * weight_x[k];
  }
  return sum;
}

}  // namespace

PreparedImage::PreparedImage(const GrayImage& image, const PixelRegion& region,
                             const CorrelationOptions& options, const Eigen::Matrix2d& gradient)
    : region_(region),
      interpolation_(options.interpolation),
      stride_(region.width + 2 * kSplinePadding) {
  const int rows = region.height + 2 * kSplinePadding;
  CheckRegion(image, region);
  saturation_ = std::make_shared<const Saturation>(image, region);
  coefficients_.resize(static_cast<std::size_t>(stride_) * rows + kSplineTail);
  const PixelRegion padded{-kSplinePadding, -kSplinePadding, stride_, rows};
  const auto filter = [&](const ImageView& view, double sigma_px) {
    const std::vector<float> kernel = CoefficientKernel(interpolation_, sigma_px);
    FilterSeparable(view, kernel, kernel, padded, options.threads, coefficients_.data(), stride_);
  };
  const double sigma_px = options.prefilter_sigma_px;
  if (gradient.isZero(0) || !(sigma_px > 0)) {
    blurred_noise_variance_ = std::pow(NoiseVarianceAfter(GaussianKernel(sigma_px)), 2);
    filter(View(image, region), sigma_px);
    return;
  }
  const Eigen::Matrix2d deformation = Eigen::Matrix2d::Identity() + gradient;
  const PlaneKernel kernel =
      GaussianPlaneKernel(sigma_px * sigma_px * deformation * deformation.transpose());
  blurred_noise_variance_ = NoiseVarianceAfter(kernel.weights);
  const GrayImage blurred = FilterPlane(Crop(image, region), kernel);
  filter(View(blurred, {0, 0, region.width, region.height}), 0);
}

std::size_t PreparedImage::bytes() const {
  const std::ptrdiff_t words = saturation_->black.words_per_row() * !saturation_->black.empty() +
                               saturation_->white.words_per_row() * !saturation_->white.empty();
  return coefficients_.size() * sizeof(float) +
         static_cast<std::size_t>(words) * sizeof(std::uint64_t) * region_.height;
}

float PreparedImage::Sample(double x_px, double y_px) const {
  const double x = x_px - region_.x, y = y_px - region_.y;
  TELESTRAIN_CHECK(x >= kSplineMargin && x <= region_.width - 1 - kSplineMargin &&
                       y >= kSplineMargin && y <= region_.height - 1 - kSplineMargin,
                   "a sampled position must be at least 3 px inside the region");
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const float* middle = &coefficients_[static_cast<std::size_t>(row + kSplinePadding) * stride_ +
                                       column + kSplinePadding];
  const float fraction_x = static_cast<float>(x - column), fraction_y = static_cast<float>(y - row);
  return interpolation_ == Interpolation::kCubic
             ? SampleSpline<3>(middle, stride_, fraction_x, fraction_y)
             : SampleSpline<5>(middle, stride_, fraction_x, fraction_y);
}

}  // namespace telestrain
