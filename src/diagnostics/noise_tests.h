#pragma once

#include <vector>

#include "diagnostics/residual_statistics.h"

namespace telestrain {

// Tests of whether residuals are nothing but noise; mrcal has none of them. All use the whitened
// residuals of the inliers. A p-value is the chance of residuals at least as bad from pure noise;
// an adjusted one holds for the whole family of tests (Holm). The residuals of a fit are a little
// less alike than noise, as the fit took out what is smooth: the spatial tests ask for too much
// likeness only, which makes them cautious (fewer false alarms than stated).

// Is the noise as large as the corners say?
struct ChiSquareTest {
  double chi2 = 0;
  int degrees = 0;
  double sigma0 = 0;       // sqrt(chi2 / degrees): noise found over noise stated
  double p_value = 1;      // of a deviation to either side
  double p_too_large = 1;  // of more
};

// Anderson and Darling's test with mean and variance estimated (Stephens in D'Agostino and
// Stephens, Goodness-of-Fit Techniques, 1986, table 4.7 and its p-value formulas).
struct NormalityTest {
  int scalars = 0;
  double skewness = 0, excess_kurtosis = 0;  // 0 for a normal distribution
  double statistic = 0;                      // A*^2
  double p_value = 1;                        // never below 1e-20
};

// Are residuals that lie together alike? Moran's I (Biometrika 37, 1950), neighbours within two
// steps of a lattice, with its moments under normality (Cliff and Ord, Spatial Processes, 1981) and
// Pearson's type III distribution, as I is skewed on few places.
struct SpatialTest {
  enum Over {
    kNeighbours,  // every corner with its neighbours on the same board in the same image
    kField,       // sums over cells of the view's field, all images: fixed in the image
    kBoard        // sums over the images of every corner: fixed in the board
  };
  Over over = kNeighbours;
  int view = 0;
  int component = 0;  // 0: u, 1: v
  int places = 0;
  double morans_i = 0, expected_i = 0, z = 0;
  double p_value = 1;           // of more likeness
  double adjusted_p_value = 1;  // over all SpatialTest
};

// Do a view's residuals drift over the images? Weighted regression of the mean residual of every
// image on its place in the order, with its t-test.
struct TrendTest {
  int view = 0, component = 0;
  int images = 0;
  double change_px = 0, sigma_change_px = 0;  // from the first to the last image
  double p_value = 1;
  double adjusted_p_value = 1;  // over all TrendTest
};

struct NoiseReport {
  ChiSquareTest chi_square;
  NormalityTest normality;
  std::vector<SpatialTest> spatial;  // by view, component, kind
  std::vector<TrendTest> trends;     // by view, component
  double SmallestSpatialP() const;   // adjusted; 1 without tests
  double SmallestTrendP() const;
};

// `degrees`: residual scalars less fitted parameters. `grid_columns`: corners along x of a board.
NoiseReport TestNoise(const ResidualList& residuals, int degrees, int grid_columns);

ChiSquareTest TestChiSquare(const ResidualList& residuals, int degrees);
NormalityTest TestNormality(std::vector<double> values);

}  // namespace telestrain
