#include <cmath>

#include "base/check.h"
#include "correlation/image_filters.h"
#include "correlation/noise_shares.h"
#include "correlation/saturation.h"
#include "correlation/spline.h"
#include "correlation/subset_correlation.h"
#include "correlation/subset_solver.h"

namespace telestrain {

using namespace correlation;

namespace {

constexpr int kTail = 16;                  // lets a vector be loaded at the last pixel
constexpr double kLeastShareInside = 0.5;  // of a subset's pixels, for a match

std::shared_ptr<const PixelBits> InsideOf(const PixelMask* mask, const GrayImage& image,
                                          const PixelRegion& region) {
  if (!mask) return nullptr;
  TELESTRAIN_CHECK(mask->width == image.width && mask->height == image.height &&
                       mask->inside.size() == image.pixels.size(),
                   "the mask must have the size of the reference image");
  const PixelBits outside = BitsWhere(region, [&](int x, int y) { return !mask->At(x, y); });
  if (outside.empty()) return nullptr;
  const PixelBits inside = BitsWhere(region, [&](int x, int y) { return mask->At(x, y); });
  return std::make_shared<const PixelBits>(inside.empty() ? PixelBits(region.width, region.height)
                                                          : inside);
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
    case MatchStatus::kSaturated:
      return "saturated";
    case MatchStatus::kMasked:
      return "masked";
  }
  return "unknown";
}

CorrelationReference::CorrelationReference(const GrayImage& image, const PixelRegion& region,
                                           const CorrelationOptions& options, const PixelMask* mask)
    : region_(region), options_(options) {
  TELESTRAIN_CHECK(options.subset_px >= 5 && options.subset_px % 2 == 1,
                   "the subset's side must be odd and at least 5 px");
  TELESTRAIN_CHECK(options.shape_order >= 0 && options.shape_order <= 2,
                   "the order of the shape function must be 0, 1 or 2");
  const ImageView view = View(image, region);
  const PixelRegion whole{0, 0, region.width, region.height};
  const std::vector<float> blur = GaussianKernel(options.prefilter_sigma_px);
  const std::vector<float> slope = SlopeKernel(options.prefilter_sigma_px);
  blurred_noise_variance_ = std::pow(NoiseVarianceAfter(blur), 2);
  const auto filtered = [&](const std::vector<float>& along_x, const std::vector<float>& along_y) {
    std::vector<float> out(static_cast<std::size_t>(region.width) * region.height + kTail);
    FilterSeparable(view, along_x, along_y, whole, options.threads, out.data(), region.width);
    return out;
  };
  gray_ = filtered(blur, blur);
  gradient_x_ = filtered(slope, blur);
  gradient_y_ = filtered(blur, slope);
  inside_ = InsideOf(mask, image, region);
  saturation_ = std::make_shared<const Saturation>(image, region);
  const auto field = [&](const std::vector<float>& values) {
    return ImageView{values.data(), region.width, region.width, region.height};
  };
  noise_shares_ =
      std::make_shared<const NoiseShares>(field(gradient_x_), field(gradient_y_), blur,
                                          inside_ ? *inside_ : PixelBits(), options.threads);
}

GrayImage CorrelationReference::BlurredImage() const {
  const auto pixels = static_cast<std::ptrdiff_t>(region_.width) * region_.height;
  return {region_.width, region_.height, 255, {gray_.begin(), gray_.begin() + pixels}};
}

// Nothing where the subset can be matched.
std::optional<MatchStatus> CorrelationReference::WhyUnusable(const PixelRegion& subset) const {
  if (subset.x < kSplineMargin || subset.y < kSplineMargin ||
      subset.x + subset.width > region_.width - kSplineMargin ||
      subset.y + subset.height > region_.height - kSplineMargin)
    return MatchStatus::kOutside;
  const double pixels = static_cast<double>(subset.width) * subset.height;
  if (inside_ && static_cast<double>(inside_->Count(subset)) < kLeastShareInside * pixels)
    return MatchStatus::kMasked;
  return {};
}

SubsetMatch CorrelationReference::Match(const Eigen::Vector2i& center_px,
                                        const PreparedImage& image, const ShapeFunction& start,
                                        int threads) const {
  TELESTRAIN_CHECK(image.interpolation_ == options_.interpolation,
                   "the image must be prepared with the options of the reference");
  const int side = options_.subset_px, half = side / 2;
  const PixelRegion part{center_px.x() - region_.x - half, center_px.y() - region_.y - half, side,
                         side};
  if (const auto reason = WhyUnusable(part)) {
    SubsetMatch failed;
    failed.status = *reason;
    failed.shape = start;
    return failed;
  }
  const std::size_t first = static_cast<std::size_t>(part.y) * region_.width + part.x;
  const bool masked = inside_ && inside_->Count(part) < static_cast<std::int64_t>(side) * side;
  SubsetProblem problem;
  problem.subset = {&gray_[first],
                    &gradient_x_[first],
                    &gradient_y_[first],
                    region_.width,
                    side,
                    masked ? inside_->Row(part.y) : nullptr,
                    masked ? inside_->words_per_row() : 0,
                    part.x};
  problem.noise_shares = noise_shares_->In(part);
  problem.reference_noise_variance = blurred_noise_variance_;
  problem.image_noise_variance = image.blurred_noise_variance_;
  problem.spline = {image.coefficients_.data(), image.stride_,
                    image.interpolation_ == Interpolation::kCubic ? 3 : 5};
  const PixelRegion& other = image.region_;
  problem.center_px = (center_px - Eigen::Vector2i(other.x, other.y)).cast<double>();
  problem.size_px = {other.width, other.height};
  problem.white = Saturation::Exceeds(saturation_->white, part);
  problem.saturated = saturation_->In(part);
  problem.image_saturation = image.saturation_.get();
  problem.options = &options_;
  problem.threads = threads;
  return SolveSubset(problem, start);
}

}  // namespace telestrain
