#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace telestrain {

// A measured image point with its covariance (px^2), pixel coordinates on the whole sensor.
struct ImagePoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
};

// One sub-board seen (or not) by one view in one image.
struct BoardObservation {
  std::string image;  // as written in calibration.csv
  std::string view;
  // columns x rows entries, x of the target running fastest, from the corner with the smallest
  // target x and y; empty when the board was rejected.
  std::vector<std::optional<ImagePoint>> corners;
  std::string rejected_because;  // empty when the board is used
  int line = 0;                  // of a corner table that it was read from, else 0
};

// The centre of the ruler's 2x2-square cross in one view.
struct CrossObservation {
  std::string image;
  std::string view;
  std::optional<ImagePoint> center;
  std::string rejected_because;
};

}  // namespace telestrain
