#pragma once

#include "base/gray_image.h"
#include "session/session.h"
#include "target/board_observation.h"

namespace telestrain {

// What a detector may assume before it looks: where the view lies on the sensor, and the nominal
// image of the target's axes (px per mm of target x and y, columns of a 2x2 matrix). The true axes
// lie within 45 deg of it and have the same handedness, which resolves the board's symmetries.
struct TargetSearch {
  std::string view;
  PixelRegion region;
  int columns = 0, rows = 0;  // of the board; 1 x 1 for the ruler's cross
  double square_mm = 0;
  Eigen::Matrix2d nominal_px_per_mm = Eigen::Matrix2d::Identity();
};

TargetSearch SearchForBoard(const Session& session, const NominalView& view);
TargetSearch SearchForCross(const Session& session, const NominalView& view);

// Finds and labels the inner corners of the board in the view's region; a maximum-likelihood fit of
// a blurred saddle gives each corner and its covariance. Corners that are cut off, covered or
// dirty are missing. Labels rest on what is seen: along each axis the whole board or one of its
// borders (board_ends.h); otherwise, with fewer than 12 corners over 3 x 3 places, out of focus or
// with saturated squares the board is rejected with the reason. Deterministic; thread-safe.
BoardObservation DetectBoard(const GrayImage& image, const TargetSearch& search);

// Finds the centre of the ruler's 2x2-square cross.
CrossObservation DetectCross(const GrayImage& image, const TargetSearch& search);

}  // namespace telestrain
