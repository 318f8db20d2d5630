#pragma once

#include <Eigen/Core>

#include "viz/canvas.h"
#include "viz/field_picture.h"
#include "viz/image_backdrop.h"

namespace telestrain::viz {

// Signs over an image that is drawn at 1 backdrop px = 1 canvas px.
class FieldMarks {
 public:
  // `upper_left`: corner of the image on the canvas.
  FieldMarks(Canvas* canvas, const ImageBackdrop& backdrop, const FieldScene& scene,
             const Eigen::Vector2d& upper_left);

  // All return what the legend needs to say.
  struct ArrowKey {
    double enlarged = 0;   // length of an arrow over the displacement's; 0: there are no arrows
    double length_px = 0;  // displacement of the key's arrow, a round number
  };
  ArrowKey AddArrows() const;
  // One cross for up to as many failures as would touch each other; how many points failed.
  int AddFailures() const;
  void AddSubset() const;
  // False when the grid is too fine for dots.
  bool AddGridDots() const;

  void AddCross(const Eigen::Vector2d& at) const;
  void AddSquare(const Eigen::Vector2d& center, double side_px) const;
  double PicturePx(double image_px) const { return image_px * backdrop_.magnification(); }

 private:
  Eigen::Vector2d CanvasPlace(const Eigen::Vector2d& place_px) const;

  Canvas* canvas_;
  const ImageBackdrop& backdrop_;
  const FieldScene& scene_;
  Eigen::Vector2d upper_left_;
};

}  // namespace telestrain::viz
