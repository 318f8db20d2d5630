#pragma once

#include <vector>

#include "calibration/bundle_adjustment.h"
#include "diagnostics/mrcal_lattice.h"
#include "diagnostics/mrcal_problem.h"

namespace telestrain {

// The telecentric array as problems that mrcal takes.
//
// Limit: a pinhole at the distance D = 1e12 mm with focal length m D sees parallel rays: depths of
// 20 mm change a pixel by 2e-11 of its distance from the axis, 1e-7 px. The core is locked, so the
// camera's distance takes the magnification's place (m = focal length / distance), and lengths are
// in km, near which mrcal's step sizes are. Coefficients of mm^-n are multiplied by D^n. A view
// behind an odd number of mirrors needs nothing: with parallel rays it is a proper rotation, seen
// from behind (TelecentricView::Rotation).
//
// Plate: mrcal's target is one regular grid, a plate holds several that lie where its certificate
// says, in general not a whole number of squares apart.
// - To evaluate, every sub-board is a problem of its own: its grid, bows and corners, with the pose
//   of the plate times the place of the board. This is exact.
// - To optimise, all boards must share one frame. In the limit the image of a flat board is affine,
//   so that the sum of squares of its corners (weights w, places b = (1, x, y), pixels q) is
//     sum w^2 |A b - q|^2 = sum v^2 |A c - p|^2 + constant
//   for any nodes c of one lattice over the whole plate with sum v^2 c c^T = sum w^2 b b^T and
//   p = A0 c, A0 the best affine image of the corners. Weights v > 0 that fulfil these six
//   equations are found by maximum entropy. mrcal so minimises the very same function of the same
//   unknowns, in which the certified places of the boards are exact; its optimum is then evaluated
//   corner by corner as above.

inline constexpr double kMrcalDistance_mm = 1e12;
inline constexpr double kMrcalUnit_mm = 1e6;

// One camera per view of the state at the limit, without the lens's residual telecentricity, which
// parallel rays cannot have.
std::vector<MrcalCamera> MrcalCamerasOf(const ArrayCalibration& array);

// mrcal's residuals (predicted minus measured, px, unweighted) of every corner of every board,
// 2xN like BoardData::pixels. `state` may have a shared or distorted lens, an aspect, a pitch and
// bows; boards that are shifted, raised or tilted against the certificate are a broken contract
// (AdjustBundle keeps them).
Result<std::vector<Eigen::Matrix2Xd>> MrcalCornerResiduals(const CalibrationData& data,
                                                           const ArrayState& state,
                                                           const std::vector<MrcalCamera>& cameras);

// The lattice problem of `data` (its corners count with IsotropicWeight) at `start`, undistorted
// with one magnification a view. Fails (kEstimationFailed) when the boards do not lie in one plane
// or so far apart that the lattice would have more than some thousand nodes.
struct LatticeProblem {
  PlateLattice lattice;
  MrcalProblem problem;
};
Result<LatticeProblem> LatticeProblemOf(const CalibrationData& data, const ArrayState& start);

// The array and the poses of a solved lattice problem: undistorted lenses, one a view.
ArrayState StateOfMrcal(const LatticeProblem& solved, const ArrayState& start);

}  // namespace telestrain
