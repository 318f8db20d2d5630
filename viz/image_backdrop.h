#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/gray_image.h"

namespace telestrain::viz {

// A grey image at the size at which a picture shows it, grey levels from 0 to 1 between the darkest
// and the lightest hundredth of the pixels. A smaller picture shows the mean of the pixels below
// each of its own, a larger one the pixels as squares.
class ImageBackdrop {
 public:
  // As large as fits into max_width x max_height px of the picture.
  ImageBackdrop(const GrayImage& image, int max_width, int max_height);

  int image_width_px() const { return image_width_px_; }
  int image_height_px() const { return image_height_px_; }
  int width() const { return width_; }  // in the picture
  int height() const { return height_; }
  double magnification() const { return magnification_; }  // picture px per image px
  float Gray(int column, int row) const {
    return gray_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(column)];
  }
  float mean_gray() const { return mean_gray_; }
  // Place in the image that the middle of a pixel of the picture shows.
  Eigen::Vector2d ImagePlace(int column, int row) const {
    return {(column + 0.5) / magnification_ - 0.5, (row + 0.5) / magnification_ - 0.5};
  }
  // Place in the backdrop of a place in the image, in px from the backdrop's upper left corner.
  Eigen::Vector2d BackdropPlace(const Eigen::Vector2d& place_px) const {
    return magnification_ * (place_px.array() + 0.5).matrix();
  }

 private:
  void Stretch();

  int image_width_px_, image_height_px_, width_ = 1, height_ = 1;
  double magnification_ = 1;
  std::vector<float> gray_;
  float mean_gray_ = 0.5F;
};

}  // namespace telestrain::viz
