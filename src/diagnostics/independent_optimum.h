#pragma once

#include "calibration/bundle_adjustment.h"

namespace telestrain {

// Does a program that knows nothing of this one find the same optimum? mrcal_telecentric.h says how
// libmrcal solves a telecentric array.
//
// Optimised: every view with a magnification of its own, no distortion, the plate as certified, no
// stage, no prior, no robust loss, one weight per corner (IsotropicWeight): the largest common part
// of both programs, in which both minimise the same function from the same start.
// Evaluated: what mrcal cannot optimise (one lens for all views, its distortion and aspect, bows)
// is compared at our solution: both must predict the same pixels.

// Bars of issue 5. Parallel rays are a limit, good to 1e-7 px (mrcal_telecentric.h). Beside it,
// both programs stop where a sum of squares in double precision stops falling: on the twenty rigs
// of the tests, whose corners hold a distortion of some tenths of a pixel that the common model
// lacks, the optima are up to 8e-8 px apart, without it 1e-9 px.
inline constexpr double kMaxResidualDifference_px = 1e-6;

struct IndependentOptimum {
  // Optimised: over all corners, over the views (relative), over the rotations from the first view
  // to every other one (they do not depend on the frame that either program has chosen).
  double max_residual_difference_px = 0;
  double max_magnification_difference = 0;
  double max_rotation_difference_rad = 0;
  double rms_px = 0, mrcal_rms_px = 0;  // over scalars, unweighted
  int images = 0;                       // of the data, compared
  int images_left_out = 0;              // a board of theirs shows too little for mrcal's lattice
  int iterations = 0;                   // ours; mrcal does not say
  bool mrcal_converged = false;
  double seconds = 0, mrcal_seconds = 0;  // wall clock: not for files that must repeat
  // Evaluated: over all corners.
  double evaluated_max_residual_difference_px = 0;
  // Largest of the solution's lenses. mrcal's rays are parallel: it is taken out on both sides of
  // the evaluation.
  double telecentricity_left_out_per_mm = 0;

  // By the residuals, which do not depend on how well the corners determine a parameter. (What
  // 1e-6 px means for a magnification or a rotation does: 1e-8 on boards with a radius of 300 px.)
  bool agrees() const;
};

// `solution`: the calibration's own, for the evaluation. `start`: where both optimisations start.
// Fails (kEstimationFailed) when one of the programs fails or the sub-boards do not lie in one
// plane.
Result<IndependentOptimum> CheckAgainstMrcal(const CalibrationData& data,
                                             const ArrayState& solution, const ArrayState& start);

// The parts of it, so that a test can plant a fault between them.

// What both optimise: one weight a corner, every image a pose of its own, no certified uncertainty;
// without the images that the lattice cannot take.
struct CommonProblem {
  CalibrationData data;
  ArrayState start;
  int images_left_out = 0;
};
CommonProblem CommonProblemOf(const CalibrationData& data, const ArrayState& start);

// Fills the optimised part: mrcal's optimum from the problem's start against `ours`.
Result<IndependentOptimum> CompareOptima(const CommonProblem& common, const ArrayState& ours);

}  // namespace telestrain
