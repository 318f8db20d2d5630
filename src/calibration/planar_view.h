#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "base/result.h"

namespace telestrain {

// Closed-form geometry of one telecentric view of a plane (MODEL.md 2).

// pixel = px_per_mm X + offset_px for target coordinates X (mm): the six numbers of the paper's H.
struct AffineHomography {
  Eigen::Matrix2d px_per_mm = Eigen::Matrix2d::Identity();
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();
};

// Least squares; for white pixel noise already the maximum-likelihood estimate (MODEL.md Eq. 4).
// Columns of both matrices correspond. Fails (kEstimationFailed) on fewer than three points or
// collinear ones.
Result<AffineHomography> FitAffineHomography(const Eigen::Matrix2Xd& target_mm,
                                             const Eigen::Matrix2Xd& pixels);

// The magnification (px per mm) of a lens with equal scales: the largest singular value of the
// homography's linear part. One view suffices (MODEL.md Eq. 6).
double MagnificationFromHomography(const AffineHomography& homography);

// The paper's Eq. (6): separate magnifications along u and v from at least three views, linear
// least squares. Nothing when the data do not determine them: this happens on arrays whose views
// are all tilted about one image axis (MODEL.md 2.2).
std::optional<Eigen::Vector2d> TwoMagnificationsOfPaper(
    const std::vector<AffineHomography>& homographies);

// The two rotations camera_from_target that a telecentric camera cannot tell apart: they differ by
// a reflection in the image plane, R' = S R S with S = diag(1, 1, -1) (MODEL.md 2.3, paper Eq. 8).
struct TwoFoldRotation {
  std::array<Eigen::Matrix3d, 2> camera_from_target;
  // (r13, r23) of the first one; the second has the opposite sign. Its length is sin(tilt).
  Eigen::Vector2d depth_row = Eigen::Vector2d::Zero();
};
TwoFoldRotation RotationsFromHomography(const AffineHomography& homography,
                                        double magnification_px_per_mm);

}  // namespace telestrain
