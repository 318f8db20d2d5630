#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "target/saddle_candidates.h"

namespace telestrain {

// Grid coordinates of a corner. Their origin, sense and order are arbitrary until the board is
// labelled.
using LatticeIndex = std::pair<int, int>;

// Candidates that sit on one regular grid.
struct CornerLattice {
  std::map<LatticeIndex, Eigen::Vector2d> pixels;  // on the whole sensor
  // pixel = origin + axes (i, j), fitted over all corners.
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d axes_px = Eigen::Matrix2d::Identity();
  // Bounding box of the grid coordinates.
  LatticeIndex first{0, 0}, last{0, 0};
  double irregularity = 0;  // rms deviation from that fit, in squares per coordinate

  int Count() const { return static_cast<int>(pixels.size()); }
  int Width() const { return last.first - first.first + 1; }
  // Share of the bounding box that holds corners.
  double Filling() const { return Count() / static_cast<double>(Width() * Height()); }
  int Height() const { return last.second - first.second + 1; }
  // Where the corner (i, j) is or should be.
  Eigen::Vector2d Predict(const LatticeIndex& at) const {
    return origin_px + axes_px * Eigen::Vector2d(at.first, at.second);
  }
};

// Joins candidates to grids: from a corner with four neighbours along its two edge lines, each new
// corner is looked for within a quarter of the spacing about the place that its neighbour
// predicts; it must show the same line directions and the opposite contrast. The edges that leave
// a corner point at its neighbours, so no scale or orientation has to be known; `longest_side_px`
// only limits the search. Largest grid first; grids of 16 corners
// and more share none.
std::vector<CornerLattice> FindLattices(const std::vector<SaddleCandidate>& candidates,
                                        double longest_side_px);

// Adds to the first (largest) lattice those others that continue it across a gap, a bar before the
// board for example: of at least nine corners that all fall within 0.2 squares of its places, at
// the same offset, without making it larger than columns x rows in either order. They are removed
// from the list. Contrast is not looked at; the fits do.
void JoinSeparated(int columns, int rows, std::vector<CornerLattice>* lattices);

// Removes end lines that are filled to less than 40 % while the grid is larger than
// columns x rows in either order: saddles of the background that happen to continue the grid.
void TrimSpuriousLines(int columns, int rows, CornerLattice* lattice);

}  // namespace telestrain
