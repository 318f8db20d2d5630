#include "simulation/scene_image.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace telestrain {
namespace {

constexpr int kNodeStep_px = 16;
constexpr double kDustEnd_radii = 1.6;  // exp(-1.6^4) = 1.4e-3 of its attenuation is left

// The light of a view's own gradient and of the lens's fall-off.
void LightRow(const VirtualInstrument& instrument, const InstrumentView& view, int y,
              std::span<float> gray) {
  const PixelRegion& region = view.region;
  const double down = (y - region.Middle().y()) / (0.5 * region.height);
  const double level = instrument.exposure * (1 + view.illumination_slope.y() * down);
  const double slope = instrument.exposure * view.illumination_slope.x() / (0.5 * region.width);
  const Eigen::Vector2d middle(0.5 * (instrument.width_px - 1), 0.5 * (instrument.height_px - 1));
  const double falloff = instrument.illumination_falloff / middle.squaredNorm();
  const double below2 = (y - middle.y()) * (y - middle.y());
  for (int x = 0; x < region.width; ++x) {
    const double right = region.x + x - region.Middle().x(), beside = region.x + x - middle.x();
    const double light = (level + slope * right) * (1 - falloff * (beside * beside + below2));
    gray[x] *= static_cast<float>(light);
  }
}

void ShadeRow(const VirtualInstrument& instrument, const InstrumentView& view,
              const RowShader& shader, int y, std::span<float> row) {
  const PixelRegion& region = view.region;
  const auto ideal_mm = IdealOfRow(instrument.lens, region.x, y, region.width);
  const std::span<float> gray = row.subspan(region.x, region.width);
  shader(view, ideal_mm, gray);
  LightRow(instrument, view, y, gray);
}

void DustRow(const DustSpeck& speck, int y, std::span<float> row) {
  const double reach_px = kDustEnd_radii * speck.radius_px, dy = y - speck.center_px.y();
  if (std::abs(dy) > reach_px) return;
  const int width = static_cast<int>(row.size());
  const int first = static_cast<int>(std::ceil(speck.center_px.x() - reach_px));
  const int last = static_cast<int>(std::floor(speck.center_px.x() + reach_px));
  for (int x = std::max(0, first); x <= std::min(width - 1, last); ++x) {
    const double dx = x - speck.center_px.x();
    const double radii2 = (dx * dx + dy * dy) / (speck.radius_px * speck.radius_px);
    row[x] *= static_cast<float>(1 - speck.attenuation * std::exp(-radii2 * radii2));
  }
}

}  // namespace

Eigen::Vector4d CubicWeights(double t) {
  return {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
          (t + 1) * t * (t - 1) / 6};
}

std::vector<Eigen::Vector2d> IdealOfRow(const TelecentricLens& lens, int first_x, int y,
                                        int count) {
  std::vector<Eigen::Vector2d> nodes;
  for (int x = -kNodeStep_px; x < count + 2 * kNodeStep_px; x += kNodeStep_px)
    nodes.push_back(lens.IdealFromPixel({first_x + x, y}));
  std::vector<Eigen::Vector2d> ideal_mm(static_cast<std::size_t>(count));
  for (int x = 0; x < count; ++x) {
    const double t = static_cast<double>(x % kNodeStep_px) / kNodeStep_px;
    const Eigen::Vector4d weights = CubicWeights(t);
    const Eigen::Vector2d* node = &nodes[x / kNodeStep_px];
    ideal_mm[x] =
        weights[0] * node[0] + weights[1] * node[1] + weights[2] * node[2] + weights[3] * node[3];
  }
  return ideal_mm;
}

GrayImage RenderScene(const VirtualInstrument& instrument, const RowShader& shader, int threads) {
  GrayImage image{instrument.width_px, instrument.height_px, 255, {}};
  const auto width = static_cast<std::size_t>(image.width);
  image.pixels.resize(width * static_cast<std::size_t>(image.height));
  ParallelFor(image.height, threads, [&](int y) {
    const std::span<float> row(&image.pixels[static_cast<std::size_t>(y) * width], width);
    for (const InstrumentView& view : instrument.views)
      if (y >= view.region.y && y < view.region.y + view.region.height)
        ShadeRow(instrument, view, shader, y, row);
    for (const DustSpeck& speck : instrument.dust) DustRow(speck, y, row);
  });
  return image;
}

}  // namespace telestrain
