#include "base/check.h"
#include "correlation/float_vector.h"
#include "correlation/image_filters.h"
#include "correlation/quintic_spline.h"
#include "correlation/subset_correlation.h"
#include "correlation/subset_solver.h"

namespace telestrain {

using namespace correlation;

namespace {

// beta5 and its derivative at the nodes around a pixel.
const std::vector<float> kValueAtNodes = {1.f / 120, 26.f / 120, 66.f / 120, 26.f / 120, 1.f / 120};
const std::vector<float> kSlopeAtNodes = {-1.f / 24, -10.f / 24, 0.f, 10.f / 24, 1.f / 24};

// Lets a vector be loaded at the last pixel.
std::vector<float> WithTail(GrayImage&& image) {
  std::vector<float> values = std::move(image.pixels);
  values.resize(values.size() + kLanes, 0.f);
  return values;
}

}  // namespace

std::string ToText(MatchStatus status) {
  switch (status) {
    case MatchStatus::kConverged:
      return "converged";
    case MatchStatus::kLowContrast:
      return "low contrast";
    case MatchStatus::kOutside:
      return "outside the image";
    case MatchStatus::kNotConverged:
      return "not converged";
    case MatchStatus::kLowCorrelation:
      return "low correlation";
  }
  return "unknown";
}

CorrelationReference::CorrelationReference(const GrayImage& image, const PixelRegion& region,
                                           const CorrelationOptions& options)
    : region_(region), options_(options) {
  TELESTRAIN_CHECK(options.subset_px >= 5 && options.subset_px % 2 == 1,
                   "the subset's side must be odd and at least 5 px");
  const std::vector<float> kernel = GaussianKernel(options.prefilter_sigma_px);
  const double along = NoiseVarianceAfter(kernel);
  blurred_noise_variance_ = along * along;
  GrayImage gray = Blur(Crop(image, region), kernel);
  GrayImage spline = gray;
  ToSplineCoefficients(spline);
  GrayImage gradient_x = FilterColumns(FilterRows(spline, kSlopeAtNodes), kValueAtNodes);
  GrayImage gradient_y = FilterColumns(FilterRows(spline, kValueAtNodes), kSlopeAtNodes);
  noise_gradient_x_ = WithTail(Blur(gradient_x, kernel));
  noise_gradient_y_ = WithTail(Blur(gradient_y, kernel));
  gray_ = WithTail(std::move(gray));
  gradient_x_ = WithTail(std::move(gradient_x));
  gradient_y_ = WithTail(std::move(gradient_y));
}

SubsetMatch CorrelationReference::Match(const Eigen::Vector2i& center_px,
                                        const PreparedImage& image,
                                        const ShapeFunction& start) const {
  const int side = options_.subset_px, half = side / 2;
  const int left = center_px.x() - region_.x - half, top = center_px.y() - region_.y - half;
  SubsetMatch outside;
  outside.status = MatchStatus::kOutside;
  outside.shape = start;
  if (left < kSplineMargin || top < kSplineMargin || left + side > region_.width - kSplineMargin ||
      top + side > region_.height - kSplineMargin)
    return outside;

  const std::size_t first = static_cast<std::size_t>(top) * region_.width + left;
  SubsetProblem problem;
  problem.subset = {&gray_[first], &gradient_x_[first], &gradient_y_[first], region_.width, side};
  problem.noise_subset = problem.subset;
  problem.noise_subset.gradient_x = &noise_gradient_x_[first];
  problem.noise_subset.gradient_y = &noise_gradient_y_[first];
  problem.reference_noise_variance = blurred_noise_variance_;
  problem.image_noise_variance = image.blurred_noise_variance_;
  problem.spline = {image.coefficients_.data(), image.stride_};
  const PixelRegion& other = image.region_;
  problem.center_px = (center_px - Eigen::Vector2i(other.x, other.y)).cast<double>();
  problem.size_px = {other.width, other.height};
  problem.options = &options_;
  return SubsetSolver(problem).Solve(start);
}

}  // namespace telestrain
