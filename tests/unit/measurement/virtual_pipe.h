#pragma once

#include <functional>
#include <vector>

#include "measurement/strain.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain::testing_support {

using Motion = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

// Points on an 8 mm pipe in both fields and where their images go under a motion; no image
// involved.
struct VirtualPipe {
  ArrayCalibration array;
  PipeGrid grid;

  explicit VirtualPipe(double telecentricity_per_mm = 0) {
    const SyntheticArray synthetic = MakeSyntheticArray({});
    array.lenses = {synthetic.lens};
    array.lenses.front().telecentricity_per_mm = telecentricity_per_mm;
    array.views = synthetic.views;
    array.covariance = array.covariance_of_noise = Eigen::MatrixXd::Zero(21, 21);
    grid.pipe.axis_point_mm = {0, 0, -4};
    grid.pipe.radius_mm = 4;
    grid.step_px = 61;
    for (int g = 0; g < 2; ++g)
      grid.pairs.push_back(
          {g == 0 ? "A" : "B", 2 * g, 2 * g + 1, {0, 0.5, -0.866}, {0, -0.5, -0.866}});
    for (int g = 0; g < 2; ++g)
      for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 12; ++column) AddPoint(g, row, column);
  }

  void AddPoint(int g, int row, int column) {
    const double angle = (row - 4) * 0.06;
    const Eigen::Vector3d wanted((g == 0 ? -13.85 : 13.85) + (column - 5.5) * 0.268,
                                 4 * std::sin(angle), 4 * std::cos(angle) - 4);
    PipePoint point;
    point.group = g;
    point.row = row;
    point.column = column;
    // The surface point that the whole first pixel sees, so that both pixels are exact.
    point.first_center_px = array.Project(2 * g, wanted).array().round().cast<int>();
    const ImageRay ray = array.RayOf(2 * g, point.first_center_px.cast<double>());
    point.reference_in_array_mm =
        grid.pipe.Enter(ray.point_in_array_mm, ray.direction_in_array).value();
    point.second_pixel = array.Project(2 * g + 1, point.reference_in_array_mm);
    point.second_center_px = point.second_pixel.array().round().cast<int>();
    grid.points.push_back(point);
  }

  std::vector<TrackedPoint> Track(const Motion& motion, double noise_px = 0,
                                  std::uint64_t seed = 1) const {
    Random random(seed);
    std::vector<TrackedPoint> tracked;
    for (const PipePoint& point : grid.points) {
      // The exact material point of the first pixel on the second view's ray.
      const Eigen::Vector3d moved = motion(point.reference_in_array_mm);
      const Eigen::Vector3d from = point.reference_in_array_mm;
      TrackedPoint t;
      t.zncc = 1;
      for (int side = 0; side < 2; ++side) {
        const int view = 2 * point.group + side;
        const Eigen::Vector2d at =
            side == 0 ? point.first_center_px.cast<double>() : point.second_pixel;
        Eigen::Vector2d pixel = at + array.Project(view, moved) - array.Project(view, from);
        pixel += Eigen::Vector2d(random.Normal(noise_px), random.Normal(noise_px));
        t.measured[static_cast<std::size_t>(side)] = {
            view, pixel, noise_px * noise_px * Eigen::Matrix2d::Identity()};
      }
      tracked.push_back(t);
    }
    return tracked;
  }
};

}  // namespace telestrain::testing_support
