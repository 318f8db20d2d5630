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
  int found_by_search = 0;  // of those found: along the epipolar line, not where the pipe says
};

// The two views of one image that are matched.
struct StereoImages {
  const GrayImage& image;
  const CorrelationReference& first;
  const PixelRegion& second;
};

// Matches a grid of subsets, `step_px` apart, of the first view to the second one. The second image
// is first drawn as the first view would see it if the surface were `pipe`: what is left to match
// is what the pipe does not say, without the turn, stretch and bend between the views, and both
// images are blurred alike on the surface. A subset that does not match is searched for along the
// epipolar line. Only subsets that lie wholly on the part of the pipe that both views show count as
// nodes.
StereoMatches MatchAcross(const ArrayCalibration& array, const StereoPair& pair,
                          const Cylinder& pipe, const StereoImages& views, int step_px);

}  // namespace telestrain
