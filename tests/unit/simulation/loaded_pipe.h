#pragma once

#include "geometry/rotation.h"
#include "simulation/deformed_pipe.h"

namespace telestrain::testing_support {

// An 8 mm pipe, stretched by 750 and bent by 40 microstrain, a little out of its place.
inline DeformedPipe LoadedPipe() {
  DeformedPipe pipe;
  pipe.radius_mm = 4;
  pipe.poisson_ratio = 0.31;
  pipe.membrane_strain = 750e-6;
  pipe.curvature_per_mm = 40e-6 / 4;
  pipe.array_from_pipe = ExpRotation({0.001, -0.002, 0.0015});
  pipe.origin_in_array_mm = {0.04, -0.03, -4.02};
  return pipe;
}

}  // namespace telestrain::testing_support
