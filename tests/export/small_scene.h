#pragma once

#include "viz/scene/part.h"
#include "viz/scene/scene.h"

namespace telestrain::viz::testing {

// Two views that look down on a pipe of 4 mm radius along x, whose two patches were measured in
// three states: 0 is the reference, 1 the largest. Point 0 has no hoop strain in state 1.
Scene SmallScene();
inline constexpr int kColumns = 5, kRows = 4;  // of points on either patch
// The axial strain at a point in a state.
double AxialStrain_microstrain(const Eigen::Vector3d& point_in_array_mm, std::size_t state);

}  // namespace telestrain::viz::testing
