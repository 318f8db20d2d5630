#include "export/small_scene.h"

#include <cmath>
#include <limits>

namespace telestrain::viz::testing {
namespace {

constexpr double kRadius_mm = 4, kLoads[] = {0, 1, 0.5};

ViewVolume View(const std::string& group, double x_mm) {
  ViewVolume view;
  view.name = group + "1";
  view.group = group;
  view.center_in_array_mm = {x_mm, 0, 0};
  view.image_y_in_array = -Eigen::Vector3d::UnitY();
  view.width_mm = 6;
  view.height_mm = 4;
  view.depth_of_field_mm = 3;
  return view;
}

void AddPatch(int group, std::size_t state, Surface* surface) {
  const int first = group * kColumns * kRows;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double x_mm = (group == 0 ? -12.0 : 12.0) + 0.5 * column, y_mm = 0.7 * row - 1;
      const double strain = AxialStrain_microstrain({x_mm, y_mm, 0}, state);
      const Eigen::Vector3d moved(1e-6 * strain * x_mm, 0, 1e-4 * kLoads[state]);
      surface->points_in_array_mm.push_back(
          Eigen::Vector3d(x_mm, y_mm, std::sqrt(kRadius_mm * kRadius_mm - y_mm * y_mm) - 4) +
          moved);
      surface->displacement_mm.push_back(moved);
      surface->sigma_um.push_back(0.1 + 0.01 * row);
      surface->values[0].values.push_back(strain);
      surface->values[1].values.push_back(-0.3 * strain);
      surface->values[2].values.push_back(surface->sigma_um.back());
      surface->group.push_back(group);
    }
  for (int row = 0; row + 1 < kRows; ++row)
    for (int column = 0; column + 1 < kColumns; ++column) {
      const int corner = first + row * kColumns + column;
      surface->quads.push_back({corner, corner + 1, corner + 1 + kColumns, corner + kColumns});
    }
}

PipeState State(std::size_t index) {
  PipeState state;
  state.image = "pipe/" + std::to_string(index) + ".png";
  state.cycle = index == 0 ? "0" : "1";
  state.step = std::to_string(index);
  state.axial_microstrain = 800 * kLoads[index];
  state.standard_uncertainty_microstrain = 11.3;
  state.surface.values = {{{"axial_microstrain", "axial strain", "\u00b5\u03b5"}, {}},
                          {{"hoop_microstrain", "hoop strain", "\u00b5\u03b5"}, {}},
                          {{"sigma_um", "standard uncertainty along the pipe", "\u00b5m"}, {}}};
  AddPatch(0, index, &state.surface);
  AddPatch(1, index, &state.surface);
  if (index == 1) state.surface.values[1].values[0] = std::numeric_limits<double>::quiet_NaN();
  return state;
}

}  // namespace

double AxialStrain_microstrain(const Eigen::Vector3d& point_in_array_mm, std::size_t state) {
  return kLoads[state] * (800 + 10 * point_in_array_mm.x() + 40 * point_in_array_mm.y());
}

Scene SmallScene() {
  Scene scene;
  scene.views = {View("A", -11), View("B", 13)};
  scene.magnification_px_per_mm = 200;
  Pipe pipe;
  pipe.axis_point_in_array_mm = {0, 0, -kRadius_mm};
  pipe.radius_mm = kRadius_mm;
  pipe.nominal_radius_mm = kRadius_mm;
  pipe.base_length_mm = 24;
  for (std::size_t i = 0; i < std::size(kLoads); ++i) pipe.states.push_back(State(i));
  pipe.largest_state = 1;
  scene.pipe = pipe;
  return scene;
}

}  // namespace telestrain::viz::testing
