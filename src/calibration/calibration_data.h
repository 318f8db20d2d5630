#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/result.h"
#include "calibration/target_shape.h"
#include "session/session.h"
#include "target/board_observation.h"

namespace telestrain {

// One board in one view of one image, ready for estimation.
struct BoardData {
  int image = 0;                          // index into CalibrationData::images
  int view = 0;                           // index into Session::views
  std::vector<int> corner;                // index in the full grid of each column below
  BoardGeometry geometry;                 // of the sub-board, by its certificate
  Eigen::Matrix2Xd corners_in_board_mm;   // by its certificate, from the board's middle
  Eigen::Matrix3Xd corners_in_target_mm;  // by its certificate
  Eigen::Matrix2Xd pixels;
  std::vector<Eigen::Matrix2d> whitening;  // W with W^T W = inverse covariance of each corner

  Eigen::Index Count() const { return pixels.cols(); }
  void RemoveCorners(const std::vector<bool>& remove);
};

struct RejectedObservation {
  std::string image;
  std::string view;
  std::string reason;
  int corners = 0;          // corners lost by it; 0 when none had been found
  bool whole_board = true;  // false: the board is used without these corners
};

// What the calibration works on: the usable boards, and the rest with its reasons.
struct CalibrationData {
  std::vector<CalibrationImage> images;  // those that two directions see
  std::vector<BoardData> boards;         // ordered by image, then view
  TargetSpec target;                     // its certificate gives the priors of the adjustment
  std::vector<RejectedObservation> rejected;
  double floor_px = 0;  // that the whitening holds beside the corners' own noise

  Eigen::Index CornerCount() const;
  // Drops boards of images that no two views from different directions see, and images without a
  // board: the depth of such a pose is not determined. Called again whenever boards were removed.
  void DropUndeterminedImages(const Session& session);
};

// `floor_px`: added in quadrature to every corner's own standard deviation, so that a few very
// certain corners cannot dominate a slightly imperfect model.
Result<CalibrationData> CollectCalibrationData(const Session& session,
                                               const std::vector<BoardObservation>& observations,
                                               double floor_px = 0.001);

// Whether corners (indices in the grid) give an affine image of their board and a check of it: at
// least four that do not lie on one line.
bool GiveAnAffineImage(const std::vector<int>& corners, int grid_columns);

inline constexpr const char* kCulledReason = "inside a culled region";

// Takes the corners inside the regions (sensor pixels) out and lists them as rejected; a board that
// keeps too few goes whole.
void CullRegions(const Session& session, const std::vector<PixelRegion>& regions,
                 CalibrationData& data);

}  // namespace telestrain
