#include "simulation/virtual_instrument.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "geometry/rotation.h"
#include "simulation/random_keys.h"

namespace telestrain {
namespace {

constexpr int kNodeStep_px = 16;
constexpr double kIlluminationGradient = 0.1;
// The axis of Brown's distortion misses the middle of the sensor by up to this much.
constexpr double kDecentering_mm = 0.2;

Eigen::Vector3d RandomVector(RandomStream& random, double largest) {
  const double x = random.Uniform(-largest, largest);
  const double y = random.Uniform(-largest, largest);
  return {x, y, random.Uniform(-largest, largest)};
}

TelecentricLens TrueLens(const VirtualExperimentOptions& options, const Session& nominal) {
  RandomStream random(RandomKey(options.seed, RandomPurpose::kLens));
  TelecentricLens lens = nominal.NominalLens();
  const double error = options.magnification_error_percent / 100;
  lens.magnification_px_per_mm *= 1 + random.Uniform(-error, error);
  const double corner_mm = lens.center_px.norm() / nominal.NominalMagnification_px_per_mm();
  const double k1 = options.distortion_percent / 100 / (corner_mm * corner_mm);
  const double p1 = k1 * random.Uniform(-kDecentering_mm, kDecentering_mm);
  const double p2 = k1 * random.Uniform(-kDecentering_mm, kDecentering_mm);
  lens.distortion = {k1, 0, p1, p2, 0};
  return lens;
}

InstrumentView TrueView(const VirtualExperimentOptions& options, const NominalView& nominal,
                        const TelecentricLens& lens, RandomStream& random) {
  InstrumentView result;
  const Eigen::Matrix3d error =
      ExpRotation(RandomVector(random, options.view_error_deg * std::numbers::pi / 180));
  result.view.name = nominal.name;
  result.view.group = nominal.group;
  result.view.axes_in_array =
      RotationFromRows(nominal.image_x_in_array, nominal.image_y_in_array).topRows<2>() * error;
  result.region = nominal.region;
  result.center_in_array_mm =
      nominal.center_in_array_mm + RandomVector(random, options.view_error_mm);
  result.view.offset_mm = lens.IdealFromPixel(nominal.region.Middle()) -
                          result.view.axes_in_array * result.center_in_array_mm;
  const Eigen::Vector3d ray = result.view.RayDirection();
  result.viewing_direction = ray.dot(nominal.axis_in_array) < 0 ? Eigen::Vector3d(-ray) : ray;
  const double angle = random.Uniform(0, 2 * std::numbers::pi);
  const Eigen::Vector2d slope(std::cos(angle), std::sin(angle));
  result.illumination_slope = kIlluminationGradient * slope / slope.lpNorm<1>();
  return result;
}

// Cubic through four equidistant nodes at -1, 0, 1, 2.
Eigen::Vector2d CubicBetween(const Eigen::Vector2d* node, double t) {
  const double a = -t * (t - 1) * (t - 2) / 6, b = (t + 1) * (t - 1) * (t - 2) / 2;
  const double c = -(t + 1) * t * (t - 2) / 2, d = (t + 1) * t * (t - 1) / 6;
  return a * node[0] + b * node[1] + c * node[2] + d * node[3];
}

void ShadeRow(const VirtualInstrument& instrument, const InstrumentView& view,
              const RowShader& shader, int y, std::span<float> row) {
  const PixelRegion& region = view.region;
  const auto ideal_mm = IdealOfRow(instrument.lens, region.x, y, region.width);
  const std::span<float> gray = row.subspan(region.x, region.width);
  shader(view, ideal_mm, gray);
  const double down = (y - region.Middle().y()) / (0.5 * region.height);
  for (int x = 0; x < region.width; ++x) {
    const double right = (region.x + x - region.Middle().x()) / (0.5 * region.width);
    gray[x] *= static_cast<float>(1 + view.illumination_slope.dot(Eigen::Vector2d(right, down)));
  }
}

}  // namespace

VirtualInstrument MakeInstrument(const VirtualExperimentOptions& options, const Session& nominal) {
  VirtualInstrument instrument;
  instrument.width_px = nominal.sensor.width_px;
  instrument.height_px = nominal.sensor.height_px;
  instrument.depth_of_field_mm = nominal.depth_of_field_mm;
  instrument.lens = TrueLens(options, nominal);
  RandomStream random(RandomKey(options.seed, RandomPurpose::kViews));
  for (const NominalView& view : nominal.views)
    instrument.views.push_back(TrueView(options, view, instrument.lens, random));
  instrument.blur_sigma_px = std::sqrt(options.psf_sigma_px * options.psf_sigma_px + 1.0 / 12.0);
  return instrument;
}

std::vector<Eigen::Vector2d> IdealOfRow(const TelecentricLens& lens, int first_x, int y,
                                        int count) {
  std::vector<Eigen::Vector2d> nodes;
  for (int x = -kNodeStep_px; x < count + 2 * kNodeStep_px; x += kNodeStep_px)
    nodes.push_back(lens.IdealFromPixel({first_x + x, y}));
  std::vector<Eigen::Vector2d> ideal_mm(static_cast<std::size_t>(count));
  for (int x = 0; x < count; ++x) {
    const double t = static_cast<double>(x % kNodeStep_px) / kNodeStep_px;
    ideal_mm[x] = CubicBetween(&nodes[x / kNodeStep_px], t);
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
  });
  return image;
}

}  // namespace telestrain
