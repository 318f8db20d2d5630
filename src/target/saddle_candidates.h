#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/gray_image.h"
#include "session/session.h"

namespace telestrain {

// A point of the image where two edges cross as in a checkerboard, good to some tenths of a pixel.
struct SaddleCandidate {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // on the whole sensor
  double strength = 0;                     // Ixy^2 - Ixx Iyy of the smoothed image, gray^2/px^4
  double bright_angle_rad = 0;             // direction from the corner into a bright sector, mod pi
  std::array<double, 2> line_angle_rad{};  // directions of the two edge lines, mod pi, ascending
  double hold_radius_px = 0;               // largest circle about it on which the test below passed
  double amplitude_gray = 0;               // half the difference bright - dark on that circle
};

// How to look for saddles.
struct SaddleSearch {
  PixelRegion region;
  int reduction = 1;          // the image is averaged over squares of so many pixels first
  double smoothing_px = 1.0;  // Gaussian, in pixels of the reduced image
  // Circles on which a candidate must show exactly four alternations, alike on opposite sides;
  // outer corners of a board, text and dust do not. Full-size pixels, in the order they are tried.
  std::vector<double> radii_px;
  // false: one passed circle is enough, the first counts. true (scale-free search): circles are
  // tried until one fails after some passed; the last passed counts, and the first one to pass must
  // be at most three times the first tried.
  bool grow = false;
  int expected_count = 1;  // the threshold is a share of the response of rank expected_count
  double least_share = 0.01;
};

// All saddles of the region that pass, strongest first. Deterministic.
std::vector<SaddleCandidate> FindSaddles(const GrayImage& image, const SaddleSearch& search);

// Smallest angle between two directions that are known up to their sense, 0 .. pi/2.
double AngleBetweenLines(double a_rad, double b_rad);

}  // namespace telestrain
