#pragma once

#include "calibration/bundle_adjustment.h"

namespace telestrain {

// How the corners of a board would have to be numbered to fit the array: turned by half a turn
// first (a board of black and white squares looks the same then), then moved by whole squares.
struct LabelReading {
  bool turned = false;
  int columns = 0, rows = 0;      // added to the column and row of every corner
  double rms_px = 0;              // per scalar, with these labels
  double rms_as_labelled_px = 0;  // per scalar, with the labels that it has
  double shift_px = 0;            // mean length of the move on the image

  // Other labels fit ten times better than those it has.
  bool IsMislabelled() const;
};

// The best of all readings within four squares. The state must know the pose of the board's image
// from other boards than this one.
LabelReading ReadLabels(const BoardData& board, const TargetSpec& target, const ArrayState& state);

// "one square along x", "half a turn and 2 squares along -y"
std::string ToText(const LabelReading& reading);

}  // namespace telestrain
