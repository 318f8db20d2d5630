#include "calibration/solver_versions.h"

#include <ceres/version.h>

#include <Eigen/Core>

namespace telestrain {

std::vector<LibraryVersion> SolverVersions() {
  const std::string eigen = std::to_string(EIGEN_WORLD_VERSION) + "." +
                            std::to_string(EIGEN_MAJOR_VERSION) + "." +
                            std::to_string(EIGEN_MINOR_VERSION);
  return {{"Ceres", CERES_VERSION_STRING, ""}, {"Eigen", eigen, ""}};
}

}  // namespace telestrain
