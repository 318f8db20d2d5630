#pragma once

#include <optional>
#include <string>
#include <vector>

#include "target/corner_lattice.h"
#include "target/target_detector.h"

namespace telestrain {

// A grid whose corners have been named.
struct LabelledBoard {
  // columns x rows places, x of the target running fastest. `seen` is false where no candidate
  // was found and the place is a prediction.
  struct Corner {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    bool seen = false;
  };
  std::vector<Corner> corners;
  // Image of one square's sides along the target's x and y, px; fitted over the whole board.
  Eigen::Matrix2d axes_px = Eigen::Matrix2d::Identity();
  // Turn of the board against the nominal view, and by how much the next labelling that agrees
  // with the view's handedness is turned further. Their difference is what the choice rests on.
  double turn_rad = 0;
  double next_turn_rad = 0;
};

// Names the corners of a grid of exactly columns x rows places. Of the board's symmetries that
// give the axes the handedness of the nominal view the one with the smallest turn is right, since
// the true axes lie within 45 deg of the nominal ones. Nothing when the two smallest turns differ
// by less than 20 deg or the handedness cannot be had.
std::optional<LabelledBoard> LabelBoard(const CornerLattice& lattice, const TargetSearch& search);

// Why a grid is not the whole board: "cut off: ...", "partly covered: ...", "another pattern: ...";
// empty when it spans the board's bounding box, holds three quarters of the corners and has the
// size that the nominal view predicts.
std::string WhyNotWhole(const CornerLattice& lattice, const TargetSearch& search);

}  // namespace telestrain
