#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/bundle_adjustment.h"

namespace telestrain {

// Statistics of reprojection errors as mrcal 2.2 defines them (its mrcal-calibrate-cameras,
// residuals_chessboard, show_residuals_* and regional statistics), so that a figure of ours can be
// held against one of mrcal's. A residual here is measured minus predicted; mrcal's x is predicted
// minus measured, times the weight: means and directions have the opposite sign there, all else is
// equal for weights of 1. Outliers stay in the list with their flag, and every function says how it
// counts them. "Per scalar" counts x and y separately, "per corner" takes the length of both.

// The residual of one corner of one board in one view of one image. Pixels on the whole sensor.
struct CornerResidual {
  int image = 0;   // index into CalibrationData::images
  int view = 0;    // index into the array's views
  int board = 0;   // index into TargetSpec::boards
  int corner = 0;  // in the grid of the board, x running fastest
  Eigen::Vector2d observed_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();  // measured minus predicted
  Eigen::Vector2d whitened = Eigen::Vector2d::Zero();     // unit variance if the noise is as stated
  bool is_outlier = false;
};
using ResidualList = std::vector<CornerResidual>;

// The residuals of all corners that the calibration used, ordered by image, view, corner.
ResidualList ResidualsOf(const CalibrationData& data, const ArrayState& state);

// Those of one view, in order.
ResidualList OfView(const ResidualList& residuals, int view);

struct ResidualSummary {
  int corners = 0;   // outliers counted
  int outliers = 0;  // which count as zero in the next figure
  // mrcal's rms_reproj_error__pixels without regularisation: sqrt(sum of squares of the inliers /
  // scalars with those of the outliers).
  double rms_per_scalar_px = 0;
  double rms_of_inliers_per_scalar_px = 0;
  double rms_of_inliers_per_corner_px = 0;  // sqrt(2) times the former
  double mean_px = 0;                       // x and y pooled, inliers
  // mrcal's observed pixel uncertainty: standard deviation about mean_px, x and y of the inliers
  // pooled, divided by their count.
  double sigma_px = 0;
  double worst_corner_px = 0;  // length, inliers
  double rms_whitened = 0;     // per scalar, inliers
};
ResidualSummary Summarise(const ResidualList& residuals);

// The RMS per scalar of pure noise after a fit: sigma sqrt(1 - states / measurements).
double ExpectedRms_px(double sigma_px, int states, int measurements);

// Counts of the inliers' scalars in bins of equal width, the middle one centred on zero: a value x
// falls into bin floor(x / width + 1/2), gnuplot's rule.
struct ResidualHistogram {
  double bin_px = 0;
  int first_bin = 0;        // index of counts[0]; its centre is first_bin * bin_px
  std::vector<int> counts;  // no gaps; empty without residuals
  int scalars = 0;
  double mean_px = 0, sigma_px = 0;
  // The expected count of a normal distribution with this mean and sigma is
  // gaussian_scale_px times its density (mrcal's curve, equal to the count in a bin at the mean).
  double gaussian_scale_px = 0;

  double Center_px(std::size_t bin) const {
    return bin_px * (first_bin + static_cast<double>(bin));
  }
  double Gaussian(double x_px) const;  // the curve's count at x
};
inline constexpr double kMrcalBin_px = 0.02;
ResidualHistogram HistogramOfResiduals(const ResidualList& residuals, double bin_px = kMrcalBin_px);
// A quarter of a standard deviation, rounded to 1, 2 or 5 times a power of ten: for residuals so
// small that mrcal's bins hold them all in one. 0 without spread.
double BinFor_px(double sigma_px);

// One board in one view of one image.
struct BoardFigures {
  int image = 0, view = 0, board = 0;
  int inliers = 0, outliers = 0;
  double square_sum_px2 =
      0;  // of the inliers; mrcal's show_residuals_board_observation sorts by it
  double rms_per_corner_px = 0;  // sqrt(square_sum / inliers); mrcal-calibrate-cameras sorts by it
  int worst_corner = -1;         // index in the grid; -1 without inliers
  double worst_corner_px = 0;
};
// Every board, the largest RMS per corner first; equal ones by image and view.
std::vector<BoardFigures> BoardsFromWorst(const ResidualList& residuals);

// Length and direction of a residual: what vector field, magnitudes and directions are drawn from.
double Magnitude_px(const CornerResidual& residual);
double Direction_rad(const CornerResidual& residual);  // atan2(v, u) in (-pi, pi]

// Directions of the inliers in equal sectors, the first beginning at -pi.
struct DirectionHistogram {
  std::vector<int> counts;
  double mean_direction_rad = 0;
  double mean_resultant = 0;  // 0: no direction is preferred, 1: there is only one
};
DirectionHistogram DirectionsOf(const ResidualList& residuals, int sectors = 36);

// Mean and standard deviation over the field: points of a grid on the corners of the image and
// between, each with the residuals whose corner lies within half a grid step along both axes.
struct RegionalMap {
  int columns = 0, rows = 0;
  double first_x_px = 0, first_y_px = 0;  // of the first point
  double step_x_px = 0, step_y_px = 0;
  // Row by row. x and y pooled; with 5 scalars or fewer mean and sd are 0 (mrcal's rule).
  std::vector<double> mean_px, sd_px;
  std::vector<int> scalars;
};
// `region`: what one view sees of the sensor. Rows 0: so that the cells are about square.
RegionalMap RegionalStatistics(const ResidualList& residuals, const PixelRegion& region,
                               int columns = 20, int rows = 0);

// mrcal's rule for outliers, replayed: with var the mean square per scalar of the inliers, if any
// |x| or |y| exceeds 5 sqrt(var), every corner with one above 4 sqrt(var) becomes an outlier. mrcal
// solves again and repeats; here the residuals stay as they are.
struct OutlierPass {
  double sigma_px = 0;
  std::vector<std::size_t> marked;  // indices into the list; empty: no corner exceeded 5 sigma
};
OutlierPass MarkOutliers(const ResidualList& residuals);
// Passes until one marks nothing; that one is the last. Sets the flags.
std::vector<OutlierPass> ReplayOutlierRule(ResidualList& residuals);

}  // namespace telestrain
