#include "simulation/pipe_image.h"

#include <algorithm>

#include "simulation/pipe_shader.h"
#include "simulation/scene_image.h"

namespace telestrain {
namespace {

constexpr double kSpeckleDiameter_px = 7.5;
constexpr double kPatchMargin_mm = 0.6;  // errors of views and rigid motion
constexpr double kHalfArc_rad = 1.75;    // 100 deg: more than any view sees

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
    double low_mm = view.center_in_array_mm.x(), high_mm = low_mm;
    for (const InstrumentView& other : instrument.views)
      if (other.view.group == view.view.group) {
        low_mm = std::min(low_mm, other.center_in_array_mm.x());
        high_mm = std::max(high_mm, other.center_in_array_mm.x());
      }
    const double half_mm = 0.5 * view.region.width * px_mm + kPatchMargin_mm;
    // On a wide pipe a view sees less than half of it.
    const double arc_mm = std::min(radius_mm * kHalfArc_rad, 4 * half_mm);
    const SurfacePatch patch{{low_mm - half_mm, -arc_mm}, {high_mm + half_mm, arc_mm}};
    paint.groups.push_back(view.view.group);
    paint.patterns.emplace_back(key, patch, kSpeckleDiameter_px * px_mm);
  }
  return paint;
}

GrayImage RenderPipe(const VirtualInstrument& instrument, const PaintedPipe& paint,
                     const DeformedPipe& pipe, int threads) {
  const RowShader shader = [&](const InstrumentView& view, const auto& ideal_mm,
                               std::span<float> gray) {
    PipeShader(instrument, view, paint.Of(view.view.group), pipe).ShadeRow(ideal_mm, gray);
  };
  return RenderScene(instrument, shader, threads);
}

}  // namespace telestrain
