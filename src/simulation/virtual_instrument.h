#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/gray_image.h"
#include "session/session.h"
#include "simulation/virtual_experiment.h"

namespace telestrain {

// One view as it truly is.
struct InstrumentView {
  TelecentricView view;
  PixelRegion region;
  Eigen::Vector3d center_in_array_mm = Eigen::Vector3d::Zero();  // seen in the region's middle
  Eigen::Vector3d viewing_direction = Eigen::Vector3d::UnitZ();  // from the camera to the object
  // Relative change of the illumination from the region's middle to its right and lower border.
  Eigen::Vector2d illumination_slope = Eigen::Vector2d::Zero();
};

// The instrument as it truly is: a perturbed drawing.
struct VirtualInstrument {
  int width_px = 0, height_px = 0;
  double depth_of_field_mm = 0;
  TelecentricLens lens;
  std::vector<InstrumentView> views;
  // Standard deviation of everything that blurs an edge along one image axis: the Gaussian of the
  // lens and the pixel's aperture (variance 1/12 px^2) taken as one Gaussian.
  double blur_sigma_px = 0;

  double BlurSigma_mm() const { return blur_sigma_px / lens.magnification_px_per_mm; }
};

VirtualInstrument MakeInstrument(const VirtualExperimentOptions& options, const Session& nominal);

// Ideal image-plane coordinates (mm) of the pixels (first_x + i, y), i < count: the inverse of the
// lens's distortion, exact at every 16th pixel and cubic between them (error below 1e-9 mm up to
// 2 % distortion).
std::vector<Eigen::Vector2d> IdealOfRow(const TelecentricLens& lens, int first_x, int y, int count);

// Grey levels (8-bit scale, without noise and illumination gradient) that one row of one view has
// at these ideal coordinates.
using RowShader =
    std::function<void(const InstrumentView& view, const std::vector<Eigen::Vector2d>& ideal_mm,
                       std::span<float> gray)>;

// The noise-free image of a scene, rows in parallel; `max_gray` is 255.
GrayImage RenderScene(const VirtualInstrument& instrument, const RowShader& shader, int threads);

}  // namespace telestrain
