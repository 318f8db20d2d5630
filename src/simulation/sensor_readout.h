#pragma once

#include <cstdint>

#include "base/gray_image.h"

namespace telestrain {

struct SensorModel {
  int bit_depth = 8;  // 8, 10, 12 or 16
  // Standard deviation of read noise and quantisation together, on the 8-bit scale; a value below
  // quantisation's own 0.29 levels gives quantisation alone.
  double noise_gray = 0;
  // Electrons at full scale. Their shot noise has the variance gray * 255 / full_well (8-bit
  // scale); it is taken as normal. 0: none.
  double full_well_electrons = 0;
};

// Turns an ideal image (8-bit scale) into what the sensor delivers: noise, whole grey levels of
// `bit_depth` bits, clipped. Levels of 10 and 12 bits are shifted up into 16 (multiples of 64 and
// 16). Every pixel's noise follows from `key` and its place, whatever the number of threads.
GrayImage ReadOut(const GrayImage& ideal, const SensorModel& sensor, std::uint64_t key,
                  int threads = 1);

}  // namespace telestrain
