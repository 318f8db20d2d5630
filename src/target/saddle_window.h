#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/gray_image.h"
#include "session/session.h"
#include "target/edge_crossing.h"
#include "target/edge_strip.h"
#include "target/saddle_fit.h"

namespace telestrain {

// Parameters of a saddle's fit: a, gx, gy, c, cx, cy, x0, y0, angles of the lines u and v, log
// blur. Linear terms and the position count from the window's middle, px.
inline constexpr int kLinear = 6, kParameters = 11;
using SaddleNormal = Eigen::Matrix<double, kParameters, kParameters>;
using SaddleParameters = Eigen::Matrix<double, kParameters, 1>;

// The normal equations at one set of parameters.
struct SaddleEquations {
  SaddleNormal normal = SaddleNormal::Zero();
  SaddleParameters gradient = SaddleParameters::Zero();  // J^T (I - model)
  double cost = 0;
};

// The pixels of a fit, sorted once by what the model is there: the saddle about the corner, an
// edge's profile along the lines, a plane elsewhere. The sums over the planes do not depend on the
// parameters.
class SaddleWindow {
 public:
  SaddleWindow(const GrayImage& image, const PixelRegion& region, const SaddleStart& start);

  // Sorts the pixels for these parameters.
  void Sort(const SaddleParameters& parameters);
  // Whether the pixels are sorted rightly for these parameters.
  bool Holds(const SaddleParameters& parameters) const;
  // Level and contrast from the planes, or from all pixels where these are few; after `Sort`.
  void StartLinear(SaddleParameters* parameters) const;
  SaddleEquations At(const SaddleParameters& parameters) const;
  int pixels() const { return pixels_; }

 private:
  // Pixels x_begin <= x < x_end of one row.
  struct RowSpan {
    int y = 0, x_begin = 0, x_end = 0;
  };
  // Sums over pixels where the saddle is -1 or +1.
  struct Plane {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();  // of (1, x, y)
    Eigen::Vector3d gray = Eigen::Vector3d::Zero();     // gray (1, x, y)
    double gray_squares = 0;
    void Add(double x, double y, const float* gray, int count);
  };
  struct Lines;
  void SortRow(const RowSpan& row, const SaddleParameters& parameters, const Lines& lines);
  void AddPlanes(const SaddleParameters& parameters, SaddleEquations* sums) const;
  void AddStrip(int line, const SaddleParameters& parameters, const Lines& lines,
                SaddleEquations* sums) const;
  void AddMiddle(const SaddleParameters& parameters, const Lines& lines,
                 SaddleEquations* sums) const;

  const GrayImage& image_;
  Eigen::Vector2d origin_;
  double extent_px_;  // from the middle to the farthest pixel
  std::vector<RowSpan> rows_;
  int pixels_ = 0;
  SaddleParameters sorted_for_ = SaddleParameters::Zero();
  std::array<Plane, 2> planes_;  // E = -1, E = +1
  std::array<EdgeStrip, 2> strips_;
  EdgeCrossing middle_;
};

}  // namespace telestrain
