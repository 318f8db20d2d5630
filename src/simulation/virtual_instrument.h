#pragma once

#include <vector>

#include "session/session.h"
#include "simulation/blur.h"
#include "simulation/virtual_experiment.h"

namespace telestrain {

// One view as it truly is.
struct InstrumentView {
  TelecentricView view;
  PixelRegion region;
  // Seen in the region's middle. The focus plane lies across the viewing direction through it.
  Eigen::Vector3d center_in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d viewing_direction = Eigen::Vector3d::UnitZ();  // from the camera to the object
  // Relative change of the illumination from the region's middle to its right and lower border.
  Eigen::Vector2d illumination_slope = Eigen::Vector2d::Zero();

  double BeyondFocus_mm(const Eigen::Vector3d& point_in_array_mm) const {
    return viewing_direction.dot(point_in_array_mm - center_in_array_mm);
  }
};

// A soft dark spot on the window of the sensor.
struct DustSpeck {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double radius_px = 1;
  double attenuation = 0;  // share of the light that is lost in its middle
};

// The chief ray of a pixel: point + depth * direction, `depth` in mm beyond focus.
struct ChiefRay {
  Eigen::Vector3d point_in_array_mm = Eigen::Vector3d::Zero();  // in the focus plane
  Eigen::Vector3d direction_in_array = Eigen::Vector3d::UnitZ();
};

// The instrument as it truly is: a perturbed drawing.
//
// Image-plane coordinates (x, y) are the lens's, mm from its optical axis on the object side. A
// point with q = axes P + offset, the depth z beyond focus, is seen at (x, y) = q / (1 + kappa z):
// chief rays lean with the distance from the axis when the telecentricity kappa is not zero.
struct VirtualInstrument {
  int width_px = 0, height_px = 0;
  double depth_of_field_mm = 0;
  TelecentricLens lens;
  double telecentricity_per_mm = 0;
  std::vector<InstrumentView> views;

  // Standard deviation of what blurs an edge along one image axis at any aperture: the Gaussian of
  // the lens and the pixel's aperture (variance 1/12 px^2) taken as one Gaussian.
  double blur_sigma_px = 0;
  double diffraction_sigma_mm = 0;                                  // 0.21 wavelength / aperture
  double pupil_sigma = 0;                                           // half the numerical aperture
  Eigen::Vector3d vibration_in_array_mm = Eigen::Vector3d::Zero();  // rms, along one direction

  double exposure = 1;              // factor on all light
  double illumination_falloff = 0;  // share lost in the sensor's corner
  std::vector<DustSpeck> dust;

  Eigen::Vector2d Ideal(const InstrumentView& view, const Eigen::Vector3d& point_in_array_mm) const;
  Eigen::Vector2d Project(const InstrumentView& view,
                          const Eigen::Vector3d& point_in_array_mm) const {
    return lens.PixelFromIdeal(Ideal(view, point_in_array_mm));
  }
  // The points that Ideal() puts at these image-plane coordinates.
  ChiefRay RayOf(const InstrumentView& view, const Eigen::Vector2d& ideal_mm) const;

  ViewBlur BlurOf(const InstrumentView& view) const;
};

// Invents the errors of the instrument: lens, mirrors, views, light, dust.
VirtualInstrument MakeInstrument(const VirtualExperimentOptions& options, const Session& nominal);

}  // namespace telestrain
