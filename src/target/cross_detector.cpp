#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numbers.h"
#include "target/saddle_candidates.h"
#include "target/saddle_fit.h"
#include "target/target_detector.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;

// The session does not say how large the cross is, so circles grow until they leave its squares.
constexpr double kSmallestRadius_px = 2.5;
constexpr double kRadiusStep = 1.15;
constexpr double kLeastHold_px = 5;
// Candidates with less than these shares of the best one's size and contrast are no rivals.
constexpr double kRivalHold = 0.5;
constexpr double kRivalAmplitude = 0.4;
constexpr std::size_t kMostRivals = 12;
// Residuals over half the contrast: at most this for a cross, and at least so many times more for
// every rival.
constexpr double kLargestMisfit = 0.25;
constexpr double kClearMisfitRatio = 2;
constexpr double kWindowShare = 0.8;  // of the circle that still lies within the squares
constexpr double kLargestHalfWindow_px = 32;
constexpr double kLeastHalfWindow_px = 4;
// A window is kept while its residuals exceed those of the smallest window by no more than this
// share and three standard deviations of the latter (1/sqrt(2 pixels)).
constexpr double kLargestGrowthOfSigma = 0.15;
// Fits over fewer pixels, or as uncertain as this in 2-D, succeed in speckle too; crosses of 14 px
// squares in noise of 5 grey levels have 0.04 px.
constexpr int kLeastPixels = 80;
constexpr double kLargestSigma_px = 0.15;

SaddleSearch CrossSaddles(const TargetSearch& search) {
  SaddleSearch saddles;
  saddles.region = search.region;
  saddles.smoothing_px = std::min(search.region.width, search.region.height) >= 600 ? 1.6 : 1.0;
  const double largest = 0.4 * std::min(search.region.width, search.region.height);
  for (double r = kSmallestRadius_px; r <= largest; r *= kRadiusStep) saddles.radii_px.push_back(r);
  saddles.grow = true;
  saddles.expected_count = 1;
  saddles.least_share = 0.01;
  return saddles;
}

std::string AtText(const Vector2d& pixel) {
  std::string text("(");
  return text.append(FormatFixed(pixel.x(), 0)) + ", " + FormatFixed(pixel.y(), 0) + ")";
}

// Drops small candidates and those within the circle of a stronger one: noise on a cross's edges
// makes weak saddles that share its large circles.
std::vector<SaddleCandidate> OnePerPlace(const std::vector<SaddleCandidate>& strongest_first) {
  std::vector<SaddleCandidate> kept;
  for (const SaddleCandidate& candidate : strongest_first) {
    const bool is_covered = std::any_of(kept.begin(), kept.end(), [&](const auto& stronger) {
      return (candidate.pixel - stronger.pixel).norm() < stronger.hold_radius_px;
    });
    if (candidate.hold_radius_px >= kLeastHold_px && !is_covered) kept.push_back(candidate);
  }
  return kept;
}

// The candidates that may be the cross: of like size and contrast, largest first.
std::vector<SaddleCandidate> Rivals(std::vector<SaddleCandidate> candidates) {
  double largest_amplitude = 0;
  for (const auto& c : candidates)
    largest_amplitude = std::max(largest_amplitude, c.amplitude_gray);
  std::erase_if(candidates, [&](const auto& c) {
    return c.amplitude_gray < kRivalAmplitude * largest_amplitude;
  });
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.hold_radius_px > b.hold_radius_px;
  });
  std::erase_if(candidates, [largest = candidates.front().hold_radius_px](const auto& c) {
    return c.hold_radius_px < kRivalHold * largest;
  });
  if (candidates.size() > kMostRivals) candidates.resize(kMostRivals);
  return candidates;
}

SaddleStart StartAt(const SaddleCandidate& cross, double half_window_px) {
  SaddleStart start;
  start.pixel = cross.pixel;
  const auto direction = [&](std::size_t i) -> Vector2d {
    return half_window_px *
           Vector2d(std::cos(cross.line_angle_rad[i]), std::sin(cross.line_angle_rad[i]));
  };
  start.half_axis_u_px = direction(0);
  start.half_axis_v_px = direction(1);
  return start;
}

// The fit over the largest window in which the model holds.
std::optional<SaddleFit> FitCross(const GrayImage& image, const PixelRegion& region,
                                  const SaddleCandidate& cross) {
  const double largest = std::min(kWindowShare * cross.hold_radius_px, kLargestHalfWindow_px);
  const double least = std::min(largest, std::max(kLeastHalfWindow_px, 0.3 * largest));
  std::optional<SaddleFit> kept;
  double limit_gray = 0;
  for (const double share : {0.0, 0.35, 0.7, 1.0}) {
    SaddleStart start = StartAt(cross, least + share * (largest - least));
    if (kept) start.blur_px = kept->blur_px;
    const auto fit = FitSaddle(image, region, start);
    if (!fit) continue;
    if (kept && fit->sigma_gray > limit_gray) break;
    const double scatter = 3 / std::sqrt(2.0 * fit->pixels);
    if (!kept) limit_gray = fit->sigma_gray * (1 + kLargestGrowthOfSigma + scatter);
    kept = fit;
  }
  if (kept && kept->pixels < kLeastPixels) return std::nullopt;
  return kept;
}

double Misfit(const SaddleFit& fit) { return fit.sigma_gray / std::abs(fit.contrast_gray); }

// The one saddle that two crossing edges explain much better than any other, or why there is none.
struct CrossChoice {
  std::optional<SaddleFit> fit;
  std::string rejected_because;
};

CrossChoice ChooseCross(const GrayImage& image, const PixelRegion& region,
                        const std::vector<SaddleCandidate>& strongest_first) {
  const std::vector<SaddleCandidate> candidates = OnePerPlace(strongest_first);
  if (candidates.empty()) return {{}, "no cross in the view"};
  std::vector<SaddleFit> fits;
  for (const SaddleCandidate& rival : Rivals(candidates))
    if (const auto fit = FitCross(image, region, rival)) fits.push_back(*fit);
  std::stable_sort(fits.begin(), fits.end(),
                   [](const SaddleFit& a, const SaddleFit& b) { return Misfit(a) < Misfit(b); });
  if (fits.empty() || Misfit(fits[0]) > kLargestMisfit)
    return {{}, "no cross in the view: nothing there fits two crossing edges"};
  if (fits.size() > 1 && Misfit(fits[1]) < kClearMisfitRatio * Misfit(fits[0]))
    return {{},
            "ambiguous: like crosses at " + AtText(fits[0].point.pixel) + " and " +
                AtText(fits[1].point.pixel)};
  if (std::sqrt(fits[0].point.covariance_px2.trace()) > kLargestSigma_px)
    return {{},
            "no cross in the view: the best place is uncertain by more than " +
                FormatFixed(kLargestSigma_px, 2) + " px"};
  return {fits[0], {}};
}

}  // namespace

CrossObservation DetectCross(const GrayImage& image, const TargetSearch& search) {
  const PixelRegion& r = search.region;
  TELESTRAIN_CHECK(r.x >= 0 && r.y >= 0 && r.width > 0 && r.height > 0 &&
                       r.x + r.width <= image.width && r.y + r.height <= image.height,
                   "the view's region leaves the image");
  CrossObservation observation;
  observation.view = search.view;
  const CrossChoice choice =
      ChooseCross(image, search.region, FindSaddles(image, CrossSaddles(search)));
  observation.rejected_because = choice.rejected_because;
  if (choice.fit) observation.center = choice.fit->point;
  return observation;
}

}  // namespace telestrain
