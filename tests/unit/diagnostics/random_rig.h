#pragma once

#include <cstdint>

#include "calibration/bundle_adjustment.h"

namespace telestrain::testing_support {

// An array that has nothing of the real one: two or three groups anywhere on the plate, with boards
// turned by any angle; two views a group at any angles of 35 to 80 degrees, some mirrored; one
// distorted lens with an aspect; bent boards. Some boards are missing, some cut off or full of
// holes, and every corner has a covariance of its own, with long and tilted ellipses.
struct RandomRig {
  CalibrationData data;
  ArrayState truth;
  ArrayState start;  // about a pixel off, undistorted, flat
};

RandomRig MakeRandomRig(std::uint64_t seed, int images = 8);

}  // namespace telestrain::testing_support
