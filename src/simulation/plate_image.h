#pragma once

#include "base/gray_image.h"
#include "session/session.h"
#include "simulation/virtual_instrument.h"

namespace telestrain {

// Where a flat plate (target or ruler) is: p_array = array_from_plate p_plate + origin.
struct PlatePose {
  Eigen::Matrix3d array_from_plate = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin_in_array_mm = Eigen::Vector3d::Zero();

  Eigen::Vector3d InArray(const Eigen::Vector3d& point_in_plate_mm) const {
    return array_from_plate * point_in_plate_mm + origin_in_array_mm;
  }
};

enum class PlateTone { kDarkSquares, kBrightSquares };

// The noise-free image of a glass plate of 40 x 8 mm that carries the boards of `plate`: dark
// squares on a bright plate, or the inverse.
GrayImage RenderPlate(const VirtualInstrument& instrument, const TargetSpec& plate,
                      const PlatePose& pose, int threads, PlateTone tone = PlateTone::kDarkSquares);

}  // namespace telestrain
