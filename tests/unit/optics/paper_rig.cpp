#include "unit/optics/paper_rig.h"

#include <cmath>

namespace telestrain::testing_support {
namespace {

constexpr double kCenter_mm = 13.851, kHeight_mm = 40, kCameraAbove_mm = 32;

OpticalPath PathOf(const std::string& name, double sx, double sy) {
  const double half = std::sqrt(0.5), lean = std::sqrt(0.75);
  const double column_mm = 0.5 * kFieldHeight_mm * sx, row_mm = 0.5 * kFieldWidth_mm * sy;
  const double side_mm = kHeight_mm / std::sqrt(3.0) * sy;
  OpticalPath path;
  path.name = name;
  path.group = name.substr(0, 1);
  path.mirrors = {{{column_mm, row_mm, kHeight_mm}, {sx * half, 0, half}},
                  {{kCenter_mm * sx, row_mm, kHeight_mm}, {-sx * half, sy * half, 0}},
                  {{kCenter_mm * sx, side_mm, kHeight_mm}, {0, -lean * sy, -0.5}}};
  // u is along y and v along x.
  path.field_mm.extend(Eigen::Vector2d(0, 0));
  path.field_mm.extend(Eigen::Vector2d(kFieldWidth_mm * sy, kFieldHeight_mm * sx));
  path.center_in_array_mm = {kCenter_mm * sx, 0, 0};
  return path;
}

}  // namespace

OpticalRig PaperRig() {
  OpticalRig rig;
  rig.title = "paper";
  rig.camera = {{0, 0, kHeight_mm + kCameraAbove_mm},
                -Eigen::Vector3d::UnitZ(),
                Eigen::Vector3d::UnitY(),
                Eigen::Vector3d::UnitX()};
  rig.magnification_px_per_mm = 500 / 2.2;
  rig.depth_of_field_mm = 3.1;
  rig.pipe_diameter_mm = 8;
  rig.needed_field_mm = 31.3;
  rig.paths = {PathOf("A1", -1, -1), PathOf("A2", -1, 1), PathOf("B1", 1, -1), PathOf("B2", 1, 1)};
  return rig;
}

}  // namespace telestrain::testing_support
