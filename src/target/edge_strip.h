#pragma once

#include <Eigen/Core>
#include <vector>

namespace telestrain {

// The pixels near one of a saddle's two edge lines and far from the other, where the saddle is the
// one edge's blurred profile, and the sums of their least-squares problem. Sums are taken in eight
// lanes in a fixed order, so every processor gives the same bits. Errors of the profile: 2e-7.
class EdgeStrip {
 public:
  // Order of the columns: a, gx, gy, c, cx, cy, x0, y0, the line's angle, log blur.
  static constexpr int kColumns = 10;

  // The line at one set of parameters: normal, its derivative by the angle, 1 / blur.
  struct Line {
    Eigen::Vector2d center_px, normal, turned_normal;
    double inverse_blur = 1;
  };
  struct Sums {
    Eigen::Matrix<double, kColumns, kColumns> normal;  // lower triangle
    Eigen::Matrix<double, kColumns, 1> gradient;
    double cost = 0;
  };

  void Clear() { x_.clear(), y_.clear(), gray_.clear(), side_.clear(), weight_.clear(); }
  // Pixels (x, y), (x + 1, y), .. on one side (+1, -1) of the other line.
  void Append(double x, double y, double side, const float* gray, int count);
  void Pad();  // after the last pixel

  // `linear`: a, gx, gy, c, cx, cy.
  Sums At(const Line& line, const Eigen::Matrix<double, 6, 1>& linear) const;

 private:
  std::vector<double> x_, y_, gray_, side_, weight_;
};

}  // namespace telestrain
