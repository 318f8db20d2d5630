#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "viz/render.h"
#include "viz/scene/camera.h"
#include "viz/scene/color_map.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// Three bytes per pixel, top row first.
struct RgbImage {
  int width_px = 0, height_px = 0;
  int dots_per_inch = 300;
  std::vector<std::uint8_t> rgb;
  // One byte per pixel, 0 where the paper shows; empty: opaque. `rgb` is not multiplied by it.
  std::vector<std::uint8_t> alpha{};
};

// A part of a picture with a camera of its own, as it was used.
struct Panel {
  std::string name;
  // pixel = matrix [P; 1]; pixel (0,0) is the centre of the top left pixel of the picture.
  Eigen::Matrix<double, 2, 4> pixel_from_array;
  Eigen::Vector2d PixelOf(const Eigen::Vector3d& point_in_array_mm) const {
    return pixel_from_array.leftCols<3>() * point_in_array_mm + pixel_from_array.col(3);
  }
};

// A text as it was drawn.
struct PlacedText {
  std::string text;
  double size_pt = 0;
  PixelBox box;  // origin in the lower left corner of the picture
};

struct Picture {
  RgbImage image;
  std::vector<Panel> panels;
  std::vector<PlacedText> texts;
};

inline const std::string kAxialStrain = "axial_microstrain";

// What of a pipe's states a picture shows: RenderOptions' words looked up in a scene (ChoicesFor in
// picture_set.h).
struct PictureChoices {
  std::optional<std::size_t> state;  // index; none: the one with the largest strain
  std::string quantity = kAxialStrain;
  std::optional<std::array<double, 2>> range;  // of the colours; none: that of the values
};

// The standard pictures. Fail (kOutputFailed) when rendering does. The same scene gives the same
// pixels on one kind of CPU. A second of computing each at 300 dpi. `options` says how large and on
// what paper; its words for view, state, quantity and range are not read here.
Result<Picture> DrawArray(const Scene& scene, const RenderOptions& options);
// Across and along the pipe; from the instrument. Distance of the fields, stereo angle.
Result<Picture> DrawSide(const Scene& scene, const RenderOptions& options);
Result<Picture> DrawTop(const Scene& scene, const RenderOptions& options);
Result<Picture> DrawTargets(const Scene& scene, const RenderOptions& options);
// Mean and RMS of the residuals over the sensor's plane; needs scene.residual_cells.
Result<Picture> DrawResiduals(const Scene& scene, const RenderOptions& options);
// The pipe with displacement arrows and strain gauges; needs scene.pipe with states, as the next.
Result<Picture> DrawPipe(const Scene& scene, const RenderOptions& options);
Result<Picture> DrawPipeStrain(const Scene& scene, const RenderOptions& options,
                               const PictureChoices& choices = {});

// One picture of a rotation of the array about its upward axis; all have one scale.
Result<Picture> DrawTurntable(const Scene& scene, const RenderOptions& options, double azimuth_deg);

// Pictures side by side, as large as they fit, each with its name above.
struct NamedImage {
  std::string name;
  const RgbImage* image = nullptr;
};
Result<Picture> DrawContactSheet(const std::vector<NamedImage>& images, const std::string& facts,
                                 const RenderOptions& options);

// The colours of the strain pictures, for whoever compares.
ColorScale StrainScale(const Surface& surface);

}  // namespace telestrain::viz
