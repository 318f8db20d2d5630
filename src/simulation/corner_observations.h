#pragma once

#include <vector>

#include "simulation/experiment_truth.h"
#include "target/board_observation.h"

namespace telestrain {

// How far a detected corner lies from its true pixel: Gaussian, independent in u and v. Out of
// focus an edge is wider, and a corner's standard deviation grows with the square root of its
// blur (Cramer-Rao limit of an edge of given length), from `sigma_px` in focus.
struct CornerNoise {
  double sigma_px = 0.1;
  std::uint64_t key = 0;  // of the randomness
};

// What a detector would report of the true plates, without images in between: every corner that
// lies inside its view's region, labelled, with the covariance sigma_px^2 that a detector without
// a covariance of its own would be given. A board of which fewer than `min_corners` are inside is
// rejected with that reason. One entry per image and view, in the order of the truth; pixels on the
// whole sensor.
std::vector<BoardObservation> ObserveBoards(const ExperimentTruth& truth, const CornerNoise& noise,
                                            int min_corners);
std::vector<CrossObservation> ObserveCrosses(const ExperimentTruth& truth,
                                             const CornerNoise& noise);

}  // namespace telestrain
