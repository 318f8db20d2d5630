#include "simulation/pipe_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace telestrain {
namespace {

constexpr double kSpeckleDiameter_px = 7.5;
constexpr double kPaint_gray = 45, kBare_gray = 205, kBackground_gray = 22;
// Diffuse light from the instrument's side: what a surface that turns away still gets.
constexpr double kAmbient = 0.35;
constexpr double kPatchMargin_mm = 0.6;  // errors of views and rigid motion
constexpr double kHalfArc_rad = 1.75;    // 100 deg: more than any view sees

// Renders one view: keeps what is the same for all of its pixels.
class PipeShader {
 public:
  PipeShader(const VirtualInstrument& instrument, const InstrumentView& view,
             const SpecklePattern& pattern, const DeformedPipe& pipe)
      : blur_sigma_mm_(instrument.BlurSigma_mm()),
        view_(view.view),
        pattern_(pattern),
        pipe_(pipe),
        rays_(pipe, view.viewing_direction) {}

  void Shade(const std::vector<Eigen::Vector2d>& ideal_mm, std::span<float> gray) const {
    Eigen::Vector3d displacement_mm = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < gray.size(); ++i) {
      const SurfaceHit hit = rays_.Hit(view_.PointOnRay(ideal_mm[i]), displacement_mm);
      gray[i] = static_cast<float>(Gray(hit));
    }
  }

 private:
  double Gray(const SurfaceHit& hit) const {
    const double visible = 0.5 * std::erfc(hit.miss_mm / blur_sigma_mm_ * std::numbers::sqrt2 / 2);
    if (visible < 1e-6) return kBackground_gray;
    const double angle_rad = std::atan2(hit.material_mm.y(), hit.material_mm.z());
    const double stretch = 1 / std::max(hit.cos_incidence, 1 / SpecklePattern::kMaxStretch);
    const double paint =
        pattern_.Paint({hit.material_mm.x(), pipe_.radius_mm * angle_rad}, stretch);
    const Eigen::Vector3d normal(0, std::sin(angle_rad), std::cos(angle_rad));
    const double upward = std::max(0.0, pipe_.array_from_pipe.row(2).dot(normal));
    const double light = kAmbient + (1 - kAmbient) * upward;
    const double surface_gray = (kBare_gray + (kPaint_gray - kBare_gray) * paint) * light;
    return kBackground_gray + (surface_gray - kBackground_gray) * visible;
  }

  double blur_sigma_mm_;
  const TelecentricView& view_;
  const SpecklePattern& pattern_;
  const DeformedPipe& pipe_;
  PipeRays rays_;
};

}  // namespace

const SpecklePattern& PaintedPipe::Of(const std::string& group) const {
  const auto at = std::find(groups.begin(), groups.end(), group);
  TELESTRAIN_CHECK(at != groups.end(), "no paint for group " + group);
  return patterns[static_cast<std::size_t>(at - groups.begin())];
}

PaintedPipe PaintPipe(const VirtualInstrument& instrument, double radius_mm, std::uint64_t key) {
  PaintedPipe paint;
  const double px_mm = 1 / instrument.lens.magnification_px_per_mm;
  for (const InstrumentView& view : instrument.views) {
    if (std::find(paint.groups.begin(), paint.groups.end(), view.view.group) != paint.groups.end())
      continue;
    const double half_mm = 0.5 * view.region.width * px_mm + kPatchMargin_mm;
    const double x_mm = view.center_in_array_mm.x(), arc_mm = radius_mm * kHalfArc_rad;
    const SurfacePatch patch{{x_mm - half_mm, -arc_mm}, {x_mm + half_mm, arc_mm}};
    paint.groups.push_back(view.view.group);
    paint.patterns.emplace_back(key, patch, kSpeckleDiameter_px * px_mm, instrument.BlurSigma_mm());
  }
  return paint;
}

GrayImage RenderPipe(const VirtualInstrument& instrument, const PaintedPipe& paint,
                     const DeformedPipe& pipe, int threads) {
  const RowShader shader = [&](const InstrumentView& view, const auto& ideal_mm,
                               std::span<float> gray) {
    PipeShader(instrument, view, paint.Of(view.view.group), pipe).Shade(ideal_mm, gray);
  };
  return RenderScene(instrument, shader, threads);
}

}  // namespace telestrain
