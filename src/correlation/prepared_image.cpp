#include <cmath>

#include "base/check.h"
#include "correlation/image_filters.h"
#include "correlation/quintic_spline.h"
#include "correlation/subset_correlation.h"

namespace telestrain {

using namespace correlation;

PreparedImage::PreparedImage(const GrayImage& image, const PixelRegion& region,
                             const CorrelationOptions& options, const Eigen::Matrix2d& gradient)
    : region_(region), stride_(region.width + 2 * kSplinePadding) {
  const double sigma_px = options.prefilter_sigma_px;
  GrayImage spline = Crop(image, region);
  if (gradient.isZero(0) || !(sigma_px > 0)) {
    const std::vector<float> kernel = GaussianKernel(sigma_px);
    blurred_noise_variance_ = std::pow(NoiseVarianceAfter(kernel), 2);
    spline = Blur(spline, kernel);
  } else {
    const Eigen::Matrix2d deformation = Eigen::Matrix2d::Identity() + gradient;
    const PlaneKernel kernel =
        GaussianPlaneKernel(sigma_px * sigma_px * deformation * deformation.transpose());
    blurred_noise_variance_ = NoiseVarianceAfter(kernel.weights);
    spline = FilterPlane(spline, kernel);
  }
  ToSplineCoefficients(spline);
  const int rows = region.height + 2 * kSplinePadding;
  coefficients_.resize(static_cast<std::size_t>(stride_) * rows);
  auto out = coefficients_.begin();
  for (int y = 0; y < rows; ++y) {
    const int from_y = MirroredIndex(y - kSplinePadding, region.height);
    for (int x = 0; x < stride_; ++x)
      *out++ = spline.At(MirroredIndex(x - kSplinePadding, region.width), from_y);
  }
}

float PreparedImage::Sample(double x_px, double y_px) const {
  const double x = x_px - region_.x, y = y_px - region_.y;
  TELESTRAIN_CHECK(x >= kSplineMargin && x <= region_.width - 1 - kSplineMargin &&
                       y >= kSplineMargin && y <= region_.height - 1 - kSplineMargin,
                   "a sampled position must be at least 3 px inside the region");
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  float weight_x[6], weight_y[6];
  QuinticWeights(static_cast<float>(x - column), weight_x);
  QuinticWeights(static_cast<float>(y - row), weight_y);
  const std::size_t first =
      static_cast<std::size_t>(row + kSplinePadding - 2) * stride_ + column + kSplinePadding - 2;
  float sum = 0;
  for (int k = 0; k < 6; ++k) {
    float along = 0;
    for (int j = 0; j < 6; ++j) along += weight_y[j] * coefficients_[first + j * stride_ + k];
    sum += along * weight_x[k];
  }
  return sum;
}

}  // namespace telestrain
