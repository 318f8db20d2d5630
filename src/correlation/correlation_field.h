#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "correlation/pixel_mask.h"
#include "correlation/subset_correlation.h"

namespace telestrain {

// How a whole image is correlated. Positions are pixels of the reference image.
struct FieldOptions {
  CorrelationOptions correlation;
  int step_px = 0;  // between grid points; 0: a quarter of the subset
  // Where the grid points lie; nothing: the whole image. A subset may reach beyond it.
  std::optional<PixelRegion> region;
  std::optional<PixelMask> mask;  // of the size of the reference image; pixels outside never count
  int strain_window_points = 5;   // odd side of the virtual strain gauge, in grid points
  // Converged points that a strain needs in its window, as a share of the window. A corner of the
  // grid has a little more than a quarter; its sigma tells what that costs.
  double min_strain_share = 0.25;
  // Searched where nothing is known, as a share of the image's width and height.
  double max_shift_share = 0.25;
  double max_rotation_deg = 9;  // of the blocks that are searched
  // FieldTracker replaces the reference when the median correlation of the points that can be
  // measured, a failed one counting zero, falls below this. At 0.8 a third of the image's variance
  // is no longer the reference's pattern and adds to the noise.
  double update_below_zncc = 0.8;
  // Pixels of the reference that are held ready for the correlation at a time; a larger reference
  // is worked through in bands of rows, with the same result. 24 Mpx take about 0.5 GB.
  std::size_t max_band_pixels = 24'000'000;
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

// The grid, row by row, every row as long: all centres inside the region whose whole subset, with
// the border that the interpolation needs, lies inside the image. Empty when there is none.
std::vector<Eigen::Vector2i> GridCenters(int width_px, int height_px, const FieldOptions& options);

// The field of one image about which nothing is known: whole-pixel seeds by a full search, from
// there to the neighbours, the strain in the end. options.correlation and options.mask must be
// those that the reference was made with; the grid lies in the reference's region. The image may
// be of another size. The same bits for any number of threads.
CorrelationField Correlate(const CorrelationReference& reference, const GrayImage& image,
                           const FieldOptions& options);

}  // namespace telestrain
