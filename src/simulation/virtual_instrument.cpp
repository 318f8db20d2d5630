#include "simulation/virtual_instrument.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/mirror_errors.h"
#include "simulation/nominal_session.h"
#include "simulation/random_keys.h"

namespace telestrain {
namespace {

// The axis of Brown's distortion misses the middle of the sensor by up to this much.
constexpr double kDecentering_mm = 0.2;
// Standard deviation of the Gaussian that fits an Airy disc, over wavelength / aperture.
constexpr double kAirySigma = 0.21;
constexpr double kSmallestDust_px = 3, kLargestDust_px = 15;
constexpr double kFaintestDust = 0.05, kDarkestDust = 0.6;

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

// The drawn views, or those behind the drawing's mirrors with their errors.
std::vector<NominalView> ViewsBehindMirrors(const VirtualExperimentOptions& options,
                                            const Session& nominal) {
  if (options.mirror_error_mrad == 0 && options.mirror_error_um == 0) return nominal.views;
  VirtualExperimentOptions with_mirrors = options;
  with_mirrors.mirrors = true;
  const Session drawing = NominalSession(with_mirrors);
  RandomStream random(RandomKey(options.seed, RandomPurpose::kMirrors));
  std::vector<NominalView> views;
  for (const NominalView& view : drawing.views)
    views.push_back(MisalignMirrors(drawing, view, 1e-3 * options.mirror_error_mrad,
                                    1e-3 * options.mirror_error_um, random));
  return views;
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
  result.view.depth_sense = ray.dot(result.viewing_direction) < 0 ? -1 : 1;
  result.view.depth_offset_mm = -result.viewing_direction.dot(result.center_in_array_mm);
  const double angle = random.Uniform(0, 2 * std::numbers::pi);
  const Eigen::Vector2d slope(std::cos(angle), std::sin(angle));
  result.illumination_slope =
      options.illumination_gradient_percent / 100 * slope / slope.lpNorm<1>();
  return result;
}

std::vector<DustSpeck> ScatterDust(const VirtualExperimentOptions& options,
                                   const SensorSpec& sensor) {
  RandomStream random(RandomKey(options.seed, RandomPurpose::kDust));
  std::vector<DustSpeck> dust(static_cast<std::size_t>(options.dust_specks));
  for (DustSpeck& speck : dust) {
    speck.center_px.x() = random.Uniform(0, sensor.width_px - 1);
    speck.center_px.y() = random.Uniform(0, sensor.height_px - 1);
    speck.radius_px = random.Uniform(kSmallestDust_px, kLargestDust_px);
    speck.attenuation = random.Uniform(kFaintestDust, kDarkestDust);
  }
  return dust;
}

}  // namespace

VirtualInstrument MakeInstrument(const VirtualExperimentOptions& options, const Session& nominal) {
  VirtualInstrument instrument;
  instrument.width_px = nominal.sensor.width_px;
  instrument.height_px = nominal.sensor.height_px;
  instrument.depth_of_field_mm = nominal.depth_of_field_mm;
  instrument.lens = TrueLens(options, nominal);
  RandomStream random(RandomKey(options.seed, RandomPurpose::kViews));
  for (const NominalView& view : ViewsBehindMirrors(options, nominal))
    instrument.views.push_back(TrueView(options, view, instrument.lens, random));
  instrument.blur_sigma_px = std::sqrt(options.psf_sigma_px * options.psf_sigma_px + 1.0 / 12.0);
  instrument.telecentricity_per_mm = options.telecentricity_percent_per_mm / 100;
  if (options.numerical_aperture > 0)
    instrument.diffraction_sigma_mm =
        kAirySigma * 1e-3 * options.wavelength_um / options.numerical_aperture;
  instrument.pupil_sigma = 0.5 * options.numerical_aperture;
  instrument.exposure = options.exposure;
  instrument.illumination_falloff = options.illumination_falloff_percent / 100;
  instrument.dust = ScatterDust(options, nominal.sensor);
  return instrument;
}

Eigen::Vector2d VirtualInstrument::Ideal(const InstrumentView& view,
                                         const Eigen::Vector3d& point_in_array_mm) const {
  const Eigen::Vector2d q_mm = view.view.Ideal(point_in_array_mm);
  return q_mm / (1 + telecentricity_per_mm * view.BeyondFocus_mm(point_in_array_mm));
}

ChiefRay VirtualInstrument::RayOf(const InstrumentView& view,
                                  const Eigen::Vector2d& ideal_mm) const {
  const Eigen::Vector3d& axis = view.viewing_direction;
  return {view.view.PointOnRay(ideal_mm) + axis.dot(view.center_in_array_mm) * axis,
          axis + telecentricity_per_mm * view.view.axes_in_array.transpose() * ideal_mm};
}

ViewBlur VirtualInstrument::BlurOf(const InstrumentView& view) const {
  const double lens_mm = blur_sigma_px / lens.magnification_px_per_mm;
  const double variance_mm2 = lens_mm * lens_mm + diffraction_sigma_mm * diffraction_sigma_mm;
  const Eigen::Vector2d motion_mm = view.view.axes_in_array * vibration_in_array_mm;
  return {variance_mm2 * Eigen::Matrix2d::Identity() + motion_mm * motion_mm.transpose(),
          pupil_sigma};
}

}  // namespace telestrain
