#pragma once

#include "optics/optical_rig.h"

namespace telestrain::testing_support {

// The array of the paper as drawn in measurement-model.md section 13: two groups of two views,
// three mirrors a path, centres at x = -13.851 and +13.851 mm, the camera's reference 32 mm above
// the first mirrors. The views are named A1 A2 B1 B2 (group, side in y).
OpticalRig PaperRig();

inline constexpr double kFieldWidth_mm = 5.7024;   // of a quarter of the sensor, along u
inline constexpr double kFieldHeight_mm = 4.2768;  // along v

}  // namespace telestrain::testing_support
