#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace telestrain {

// A rectangle of the pipe's unrolled surface: x along the pipe, y = radius * angle.
struct SurfacePatch {
  Eigen::Vector2d lower_mm = Eigen::Vector2d::Zero();
  Eigen::Vector2d upper_mm = Eigen::Vector2d::Zero();
};

// Sprayed paint: dark discs of slightly different size at random places of the unrolled surface,
// one pattern per key, covering about half of it. The discs of a square cell of the surface follow
// from the cell's number alone (Poisson, one on average), so a pattern has no border; those within
// reach of a patch are gathered once and then looked up.
class SpecklePattern {
 public:
  // `mean_diameter_mm` of the discs; `blur_sigma_mm` is the blur's standard deviation on a surface
  // that faces the camera.
  SpecklePattern(std::uint64_t key, const SurfacePatch& patch, double mean_diameter_mm,
                 double blur_sigma_mm);

  // Share of paint, 0 to 1, that the blurred image shows at a surface point of the patch, when the
  // blur appears `stretch_y` >= 1 times wider around the pipe than along it (oblique view; taken
  // as at most kMaxStretch). Each disc's edge is blurred as if it were straight; overlapping discs
  // multiply.
  double Paint(const Eigen::Vector2d& point_mm, double stretch_y) const;

  static constexpr double kMaxStretch = 4.0;

 private:
  struct Disc {
    float x_mm, y_mm, radius_mm;
  };
  void AddCell(std::uint64_t key, int column, int row, std::vector<Disc>& discs) const;
  void BuildLookup(const std::vector<Disc>& discs);

  SurfacePatch patch_;
  double mean_radius_mm_, blur_sigma_mm_;
  double cell_mm_;    // of the hashed placing
  double lookup_mm_;  // side of a square of the look-up grid
  int columns_ = 0, rows_ = 0;
  std::vector<int> first_;  // per look-up square, and one past the last: index into near_
  std::vector<Disc> near_;
};

}  // namespace telestrain
