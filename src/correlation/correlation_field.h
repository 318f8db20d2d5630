#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "correlation/pixel_mask.h"
#include "correlation/subset_correlation.h"

namespace telestrain {

// How a whole image is correlated.
struct FieldOptions {
  CorrelationOptions correlation;
  int step_px = 0;  // between grid points; 0: a quarter of the subset
  // Where the grid lies on the reference; nothing: the whole image.
  std::optional<PixelRegion> region;
  std::optional<PixelMask> mask;  // of the size of the reference image; pixels outside never count
  int strain_window_points = 5;   // odd side of the virtual strain gauge, in grid points
};

// One grid point. Displacements run from the first reference to the image in its pixels.
struct FieldPoint {
  int column = 0, row = 0;  // in the grid
  Eigen::Vector2i center_px = Eigen::Vector2i::Zero();
  SubsetMatch match;
  // Green-Lagrange strain [xx xy; xy yy] of a plane through the displacements over the strain
  // window: invariant to rotation. NaN where too few neighbours converged.
  Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
  Eigen::Vector3d sigma_strain = Eigen::Vector3d::Zero();  // of xx, yy, xy, from the noise
};

// All grid points of one image, row by row; a point that failed is there with its status.
struct CorrelationField {
  int columns = 0, rows = 0;
  int step_px = 0, subset_px = 0;
  std::vector<FieldPoint> points;
  int reference_updates = 0;  // times the reference was replaced on the way to this image
};

// What a speckle pattern lets one expect, from one image and its region.
struct PatternAssessment {
  double speckle_px = 0;            // full width at half maximum of the autocorrelation
  double contrast_gray = 0;         // rms
  double noise_gray = 0;            // estimated from the image itself, before any blur
  double saturated_share = 0;       // of the pixels, at either end of the scale
  double gradient_gray_per_px = 0;  // rms of one component; SSSIG = subset area x its square
  int recommended_subset_px = 0, recommended_step_px = 0;
  double expected_sigma_px = 0;           // of u with the recommended subset
  double expected_sigma_microstrain = 0;  // of a strain over the recommended window
  std::vector<std::string> advice;        // plain sentences; empty when nothing is to be improved
};

}  // namespace telestrain
