#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "calibration/array_seed.h"

namespace telestrain {

// What libmrcal (2.2, mrcal.secretsauce.net) calls a calibration: cameras that see one regular grid
// in several frames. It knows nothing of this project, so what it finds is a second opinion. Only
// mrcal_problem.cpp includes its header.

// A point P of the reference frame is at (X, Y, Z) = camera_from_reference P + origin_in_camera_mm,
//   pixel = principal_px + focal_px * Brown(X / Z, Y / Z).
struct MrcalCamera {
  Eigen::Vector2d focal_px = Eigen::Vector2d::Ones();
  Eigen::Vector2d principal_px = Eigen::Vector2d::Zero();
  std::array<double, 5> distortion{};  // k1, k2, p1, p2, k3 of (X / Z, Y / Z), as in OpenCV
  Eigen::Matrix3d camera_from_reference = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin_in_camera_mm = Eigen::Vector3d::Zero();
};

// The grid in one frame, seen by one camera.
struct MrcalSighting {
  int camera = 0;
  int frame = 0;
  Eigen::Matrix2Xd pixels;      // column per node, x running fastest
  Eigen::VectorXd weight_1_px;  // of both coordinates of each node; 0: not seen
};

// Holds the reference frame, which the corners leave free, without a price: a fixed point that a
// camera must see at one or both coordinates of its principal point. Six scalars that every optimum
// can fulfil exactly, wherever the frame is put, choose the frame and change nothing else.
struct MrcalPin {
  int camera = 0;
  Eigen::Vector3d point_in_reference_mm = Eigen::Vector3d::Zero();
  bool pins_u = true, pins_v = true;
};

struct MrcalProblem {
  int columns = 0, rows = 0;
  double spacing_mm = 0;
  // Of the grid: z = bow_x (1 - (2 x / w)^2) + bow_y (1 - (2 y / h)^2), x and y from its middle.
  double bow_x_mm = 0, bow_y_mm = 0;
  // mrcal's steps assume lengths near 1: how many mm its unit of length is.
  double unit_mm = 1;
  // Moves `distortion`; focal length and principal point always stay as given, and nothing pulls
  // at any number (no regularisation).
  bool free_distortion = false;
  std::vector<MrcalCamera> cameras;
  std::vector<TargetPose> frames;        // reference from grid; the grid's first node is its origin
  std::vector<MrcalSighting> sightings;  // ordered by frame
  std::vector<MrcalPin> pins;            // none: the frame stays free
};

TargetPose Compose(const TargetPose& c_from_b, const TargetPose& b_from_a);
// Target from the grid of a sub-board whose pitch is `scale` times the nominal one.
TargetPose GridInTarget(const BoardGeometry& geometry, double scale = 1);

// Pins that these cameras fulfil: camera 0 has two points behind each other on its axis and a third
// beside them at its height, and the coordinate of another camera that moves most with the depth
// of camera 0 holds that depth. Two cameras at least, from different directions.
std::vector<MrcalPin> PinsAt(const std::vector<MrcalCamera>& cameras);

// mrcal's residuals, weight (predicted - measured), at the problem's own cameras and frames: a 2xN
// block per sighting, column per node; zero where it is not seen. Fails (kEstimationFailed) when
// mrcal refuses the problem.
Result<std::vector<Eigen::Matrix2Xd>> MrcalResiduals(const MrcalProblem& problem);

// Moves all cameras and frames to mrcal's optimum. mrcal stops when its step is short and does not
// say after how many, so it runs again from where it stopped until the sum of squares stays as it
// is.
struct MrcalOutcome {
  double rms = 0;  // of the weighted residuals of the nodes seen, over scalars
  int runs = 0;
  bool converged = false;
};
Result<MrcalOutcome> SolveWithMrcal(MrcalProblem& problem);

}  // namespace telestrain
