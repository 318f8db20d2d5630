#include "target/saddle_candidates.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "target/reduced_region.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

// The region, averaged and smoothed. Pixel (x, y) of it is the sensor's origin + reduction (x, y).
struct SmoothedRegion {
  cv::Mat1f gray;
  int reduction = 1;
  Vector2d origin_px = Vector2d::Zero();

  Vector2d SensorPixel(const Vector2d& reduced) const { return origin_px + reduction * reduced; }
};

SmoothedRegion Smooth(const GrayImage& image, const SaddleSearch& search) {
  const PixelRegion& region = search.region;
  SmoothedRegion smoothed;
  const int n = smoothed.reduction = search.reduction;
  smoothed.origin_px = Vector2d(region.x, region.y).array() + 0.5 * (n - 1);
  GrayImage reduced = ReduceRegion(image, region, n);
  if (reduced.pixels.empty()) return smoothed;
  const cv::Mat1f levels(reduced.height, reduced.width, reduced.pixels.data());
  cv::GaussianBlur(levels, smoothed.gray, cv::Size(), search.smoothing_px, search.smoothing_px,
                   cv::BORDER_REPLICATE);
  return smoothed;
}

struct Hessian {
  double xx = 0, xy = 0, yy = 0;
  double Strength() const { return xy * xy - xx * yy; }
};

Hessian HessianAt(const cv::Mat1f& gray, int x, int y) {
  const float *above = gray[y - 1], *here = gray[y], *below = gray[y + 1];
  const double center2 = 2.0 * static_cast<double>(here[x]);
  Hessian h;
  h.xx = static_cast<double>(here[x - 1] + here[x + 1]) - center2;
  h.yy = static_cast<double>(above[x] + below[x]) - center2;
  h.xy = 0.25 * static_cast<double>(above[x - 1] - above[x + 1] - below[x - 1] + below[x + 1]);
  return h;
}

cv::Mat1f StrengthImage(const cv::Mat1f& gray) {
  cv::Mat1f strength(gray.size(), 0.0F);
  for (int y = 1; y + 1 < gray.rows; ++y) {
    const float *above = gray[y - 1], *here = gray[y], *below = gray[y + 1];
    float* out = strength[y];
    for (int x = 1; x + 1 < gray.cols; ++x) {
      const float xx = here[x - 1] + here[x + 1] - 2.0F * here[x];
      const float yy = above[x] + below[x] - 2.0F * here[x];
      const float xy = 0.25F * (above[x - 1] - above[x + 1] - below[x - 1] + below[x + 1]);
      out[x] = std::max(0.0F, xy * xy - xx * yy);
    }
  }
  return strength;
}

struct Peak {
  float strength = 0;
  int x = 0, y = 0;
};

bool IsHighest(const cv::Mat1f& strength, int x, int y) {
  const float own = strength(y, x);
  for (int v = std::max(0, y - 2); v <= std::min(strength.rows - 1, y + 2); ++v) {
    const float* row = strength[v];
    for (int u = std::max(0, x - 2); u <= std::min(strength.cols - 1, x + 2); ++u)
      if (row[u] > own) return false;
  }
  return true;
}

// Positive maxima over 5 x 5 pixels that are not below `least`, from the upper left on.
std::vector<Peak> Maxima(const cv::Mat1f& strength, float least) {
  std::vector<Peak> peaks;
  for (int y = 1; y + 1 < strength.rows; ++y) {
    const float *above = strength[y - 1], *row = strength[y], *below = strength[y + 1];
    for (int x = 1; x + 1 < strength.cols; ++x) {
      const float own = row[x];
      if (own < least || own <= 0) continue;
      if (own >= row[x - 1] && own >= row[x + 1] && own >= above[x] && own >= below[x] &&
          IsHighest(strength, x, y))
        peaks.push_back({own, x, y});
    }
  }
  return peaks;
}

// The maxima that are strong enough, strongest first; of equal ones the upper left comes first.
std::vector<Peak> Peaks(const cv::Mat1f& strength, const SaddleSearch& search) {
  const float share = static_cast<float>(search.least_share);
  const auto wanted = static_cast<std::size_t>(search.expected_count);
  // Noise has many maxima: those far below the strongest are passed over where others suffice.
  double strongest = 0;
  cv::minMaxLoc(strength, nullptr, &strongest);
  std::vector<Peak> peaks = Maxima(strength, share * static_cast<float>(strongest));
  if (peaks.size() < wanted) peaks = Maxima(strength, 0);
  if (peaks.empty()) return peaks;
  const auto rank = std::min(peaks.size(), wanted) - 1;
  const auto stronger = [](const Peak& a, const Peak& b) { return a.strength > b.strength; };
  std::vector<Peak> ranked = peaks;
  std::nth_element(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(rank), ranked.end(),
                   stronger);
  peaks = Maxima(strength, share * ranked[rank].strength);
  std::stable_sort(peaks.begin(), peaks.end(), stronger);
  return peaks;
}

constexpr int kSamples = 48;
using Samples = std::array<double, kSamples>;

struct UnitCircle {
  UnitCircle() {
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double angle = 2 * kPi * static_cast<double>(i) / kSamples;
      points[i] = {std::cos(angle), std::sin(angle)};
    }
  }
  std::array<Vector2d, kSamples> points;
};

double Interpolate(const cv::Mat1f& gray, double x, double y) {
  const int ix = static_cast<int>(x), iy = static_cast<int>(y);
  const double fx = x - ix, fy = y - iy;
  const float *top = gray[iy] + ix, *bottom = gray[iy + 1] + ix;
  return (1 - fy) * ((1 - fx) * static_cast<double>(top[0]) + fx * static_cast<double>(top[1])) +
         fy * ((1 - fx) * static_cast<double>(bottom[0]) + fx * static_cast<double>(bottom[1]));
}

// The grey levels on a circle. `overhang` is the part of the radius that may lie beyond the
// image's edge; there the edge's levels continue.
std::optional<Samples> SampleCircle(const cv::Mat1f& gray, const Vector2d& center, double radius,
                                    double overhang) {
  static const UnitCircle circle;
  const double inside = radius * (1 - overhang);
  const double right = gray.cols - 1.001, bottom = gray.rows - 1.001;
  if (center.x() < inside || center.y() < inside || center.x() > right - inside ||
      center.y() > bottom - inside)
    return std::nullopt;
  Samples samples;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const Vector2d at = center + radius * circle.points[i];
    samples[i] = Interpolate(gray, std::clamp(at.x(), 0.0, right), std::clamp(at.y(), 0.0, bottom));
  }
  return samples;
}

// What a circle about a saddle shows.
struct CircleFinding {
  std::array<double, 2> line_angle_rad{};
  double amplitude_gray = 0;
};

// Subtracts the level midway between bright and dark; returns half their difference.
double Center(Samples* samples) {
  Samples sorted = *samples;
  std::sort(sorted.begin(), sorted.end());
  constexpr int kShare = kSamples / 8;
  double dark = 0, bright = 0;
  for (int i = 0; i < kShare; ++i) {
    dark += sorted[static_cast<std::size_t>(i)] / kShare;
    bright += sorted[static_cast<std::size_t>(kSamples - 1 - i)] / kShare;
  }
  for (double& sample : *samples) sample -= 0.5 * (bright + dark);
  return 0.5 * (bright - dark);
}

// Angles of the sign changes; small excursions about zero (below a sixth of the amplitude) do not
// count as a change.
std::vector<double> Crossings(const Samples& samples, double amplitude) {
  std::vector<double> angles;
  const double least = amplitude / 6;
  int start = 0;
  while (start < kSamples && std::abs(samples[static_cast<std::size_t>(start)]) < least) ++start;
  int last = start;  // last sample that was clearly bright or dark
  for (int step = 1; step <= kSamples; ++step) {
    const int i = start + step;
    const double b = samples[static_cast<std::size_t>(i % kSamples)];
    if (std::abs(b) < least) continue;
    const double a = samples[static_cast<std::size_t>(last % kSamples)];
    if ((a > 0) != (b > 0))
      angles.push_back((last + (i - last) * a / (a - b)) * 2 * kPi / kSamples);
    last = i;
  }
  return angles;
}

std::optional<CircleFinding> TestCircle(const cv::Mat1f& gray, const Vector2d& center,
                                        double radius, double overhang) {
  auto samples = SampleCircle(gray, center, radius, overhang);
  if (!samples) return std::nullopt;
  CircleFinding finding;
  finding.amplitude_gray = Center(&*samples);
  if (!(finding.amplitude_gray > 0)) return std::nullopt;
  double asymmetry = 0;
  for (std::size_t i = 0; i < kSamples / 2; ++i)
    asymmetry += std::abs((*samples)[i] - (*samples)[i + kSamples / 2]) / (kSamples / 2);
  if (asymmetry > 0.45 * finding.amplitude_gray) return std::nullopt;
  const auto angles = Crossings(*samples, finding.amplitude_gray);
  if (angles.size() != 4) return std::nullopt;
  constexpr double kLargestBend_rad = 0.35;
  for (std::size_t i = 0; i < 2; ++i) {
    const double opposite = angles[i + 2] - kPi;
    if (std::abs(opposite - angles[i]) > kLargestBend_rad) return std::nullopt;
    finding.line_angle_rad[i] = std::fmod(0.5 * (angles[i] + opposite) + 2 * kPi, kPi);
  }
  std::sort(finding.line_angle_rad.begin(), finding.line_angle_rad.end());
  return finding;
}

// Both lines of `a` have a partner in `b` within `tolerance_rad`.
bool SameLines(const CircleFinding& a, const CircleFinding& b, double tolerance_rad) {
  const auto &p = a.line_angle_rad, &q = b.line_angle_rad;
  const double straight = std::max(AngleBetweenLines(p[0], q[0]), AngleBetweenLines(p[1], q[1]));
  const double crossed = std::max(AngleBetweenLines(p[0], q[1]), AngleBetweenLines(p[1], q[0]));
  return std::min(straight, crossed) < tolerance_rad;
}

bool PassCircles(const SmoothedRegion& region, const SaddleSearch& search, const Vector2d& reduced,
                 SaddleCandidate* candidate) {
  // A true saddle alternates from its centre on.
  constexpr double kLatestStart = 3.0;
  // Corners close to the view's edge still count when the size of the circle does not matter.
  const double overhang = search.grow ? 0.0 : 0.7;
  std::optional<CircleFinding> kept;
  for (const double radius : search.radii_px) {
    if (search.grow && !kept && radius > kLatestStart * search.radii_px.front()) return false;
    const auto finding = TestCircle(region.gray, reduced, radius / search.reduction, overhang);
    if (kept && (!finding || !SameLines(*kept, *finding, 0.2))) break;
    if (!finding) continue;
    kept = finding;
    candidate->hold_radius_px = radius;
    if (!search.grow) break;
  }
  if (!kept) return false;
  candidate->line_angle_rad = kept->line_angle_rad;
  candidate->amplitude_gray = kept->amplitude_gray;
  return true;
}

// The stationary point of the quadratic through the pixel's neighbours, at most 1.5 px away.
Vector2d StationaryPoint(const cv::Mat1f& gray, const Peak& peak, const Hessian& h) {
  const int x = peak.x, y = peak.y;
  const Vector2d slope(0.5 * static_cast<double>(gray(y, x + 1) - gray(y, x - 1)),
                       0.5 * static_cast<double>(gray(y + 1, x) - gray(y - 1, x)));
  Eigen::Matrix2d curvature;
  curvature << h.xx, h.xy, h.xy, h.yy;
  const Vector2d step = -curvature.inverse() * slope;
  const bool usable = step.allFinite() && step.norm() < 1.5;
  return Vector2d(x, y) + (usable ? step : Vector2d::Zero());
}

}  // namespace

double AngleBetweenLines(double a_rad, double b_rad) {
  const double turn = std::fmod(std::abs(a_rad - b_rad), kPi);
  return std::min(turn, kPi - turn);
}

std::vector<SaddleCandidate> FindSaddles(const GrayImage& image, const SaddleSearch& search) {
  const SmoothedRegion region = Smooth(image, search);
  std::vector<SaddleCandidate> candidates;
  if (region.gray.rows < 5 || region.gray.cols < 5) return candidates;
  for (const Peak& peak : Peaks(StrengthImage(region.gray), search)) {
    const Hessian hessian = HessianAt(region.gray, peak.x, peak.y);
    const Vector2d reduced = StationaryPoint(region.gray, peak, hessian);
    SaddleCandidate candidate;
    if (!PassCircles(region, search, reduced, &candidate)) continue;
    candidate.pixel = region.SensorPixel(reduced);
    candidate.strength = static_cast<double>(peak.strength);
    candidate.bright_angle_rad = 0.5 * std::atan2(2 * hessian.xy, hessian.xx - hessian.yy);
    candidates.push_back(candidate);
  }
  return candidates;
}

}  // namespace telestrain
