#pragma once

#include <map>
#include <string>
#include <vector>

#include "correlation/subset_correlation.h"
#include "measurement/pipe_locator.h"

namespace telestrain {

// A node of the grid on the first view that was found in the second view.
struct StereoMatch {
  int column = 0, row = 0;
  Eigen::Vector2i first_center_px;
  Eigen::Vector2d second_pixel;
  Eigen::Matrix2d covariance_px2;  // of second_pixel
};

struct StereoMatches {
  std::vector<StereoMatch> found;
  std::map<std::string, int> rejected;  // reason -> nodes that both views show but do not match
  int nodes = 0;
};

// Matches a grid of subsets (step = subset) of the first view to the second one, predicted by the
// located pipe. The views may see the pattern turned or mirrored: the second image is first brought
// to the grid symmetry (of the eight) that is nearest to the first one, which moves whole pixels
// only.
StereoMatches MatchAcross(const ArrayCalibration& array, const StereoPair& pair,
                          const Cylinder& pipe, const GrayImage& image,
                          const CorrelationReference& first, const PixelRegion& second);

}  // namespace telestrain
