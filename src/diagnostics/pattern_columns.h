#pragma once

#include <Eigen/Core>

#include "calibration/bundle_adjustment.h"

// Private to the diagnostics module: how the image of one board changes with everything that a
// fit or a fault may move.
namespace telestrain {

// Columns of one board, in this order.
struct PatternLayout {
  // Of the board's view. Relative magnification, aspect, k1, k2, p1, p2, k3 and telecentricity in
  // the units of TelecentricLens; rotation (rad, about the camera's axes); offset (mm); a shift of
  // the image (px) that grows evenly by 1 from the first image to the last.
  static constexpr int kLens = 0, kLensSize = 8;
  static constexpr int kRotation = 8, kOffset = 11, kDrift = 13;
  static constexpr int kViewSize = 15;
  // Of the sub-board: relative pitch, shift, height, tilts, bows (BoardShape), twist (mm at a
  // corner of the grid), stretch (x longer, y shorter, relative), shear (relative).
  static constexpr int kPitch = 0, kShift = 1, kHeight = 2, kTiltX = 3, kTiltY = 4;
  static constexpr int kBowX = 5, kBowY = 6, kTwist = 7, kStretch = 8, kShear = 9;
  static constexpr int kBoardSize = 10;
  // Of this image alone: the target's pose (rad about the array's axes, mm), then any affine
  // change of this one board's image (px: shift, and per half width and half height).
  static constexpr int kPoseSize = 6, kAffineSize = 6;

  static constexpr int kBoardAt = kViewSize;
  static constexpr int kPoseAt = kBoardAt + kBoardSize;
  static constexpr int kAffineAt = kPoseAt + kPoseSize;
  static constexpr int kResidualAt = kAffineAt + kAffineSize;
  static constexpr int kColumns = kResidualAt + 1;
};

// Two rows per corner (u, v), whitened: derivatives of the predicted pixels by the layout's
// columns, and as the last column measured minus predicted. Analytic; the effect of small turns
// and shifts on the depth is left out (second order, as the telecentricity is small).
Eigen::MatrixXd PatternColumns(const BoardData& board, const ArrayState& state);

}  // namespace telestrain
