#pragma once

#include <span>
#include <vector>

#include "simulation/pipe_rays.h"
#include "simulation/speckle_pattern.h"

namespace telestrain {

// Shades the pixels of one view of a painted pipe before a dark background.
//
// A pixel shows the surface around its ray's hit: place, blur in surface coordinates and light are
// worked out there. All three are smooth along a row; where the surface does not turn away too much
// they are worked out at every fourth pixel and follow a cubic in between (places within 2e-7 mm).
class PipeShader {
 public:
  PipeShader(const VirtualInstrument& instrument, const InstrumentView& view,
             const SpecklePattern& pattern, const DeformedPipe& pipe);

  // Grey levels (8-bit scale, in even light) of a row's pixels at these ideal coordinates.
  void ShadeRow(const std::vector<Eigen::Vector2d>& ideal_mm, std::span<float> gray) const;

 private:
  // x and y of the surface, the blur's variances and covariance there, and the light.
  using Surface = Eigen::Matrix<double, 6, 1>;
  struct Sample {
    SurfaceHit hit;
    Surface surface = Surface::Zero();
    double visible = 0;  // share of the blurred silhouette
    bool is_smooth = false;
  };
  Sample SampleAt(const Eigen::Vector2d& ideal_mm, const SurfaceHit& neighbour) const;
  Eigen::Matrix2d CovOnSurface_mm2(const Eigen::Matrix<double, 2, 3>& q_from_section,
                                   const Eigen::Vector2d& around,
                                   const Eigen::Matrix2d& cov_q_mm2) const;
  float Gray(const Surface& surface, double visible) const;

  const VirtualInstrument& instrument_;
  const InstrumentView& view_;
  ViewBlur blur_;
  const SpecklePattern& pattern_;
  const DeformedPipe& pipe_;
  PipeRays rays_;
  double smooth_cosine_;  // of the incidence up to which the cubic is good enough
};

}  // namespace telestrain
