#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>

#include "calibration/corner_gram.h"

// Private to the calibration module: the residuals that Ceres evaluates.
namespace telestrain {

inline constexpr int kViewSize = 5;  // rotation vector, offset
inline constexpr int kPoseSize = 6;  // rotation vector, origin

// The numbers of a lens as its parameter block.
LensNumbers NumbersOfLens(const double* block, double unit_px_per_mm,
                          const Eigen::Vector2d& center_px);

// What a board's residual takes as given.
struct BoardModel {
  GramPlan plan;
  double unit_px_per_mm = 1;
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double depth_sense = 1, depth_offset_mm = 0;  // of the view
  int pose = 0, poses = 1;  // which of the poses in the pose block is the board's
};

// The residuals of one board, condensed: not two for each corner, but the ColumnCount rows of
// FactorOfBoard, which have the same squared length, gradient and Gauss-Newton matrix (MODEL.md
// Eq. 12). Parameter blocks: lens (8), view (5), poses (6 each), pitch (1), board shape (6).
// Derivatives by lens parameters that the plan does not free are zero.
class BoardResidual : public ceres::CostFunction {
 public:
  enum Block { kLens, kView, kPose, kPitch, kShape, kBlocks };

  BoardResidual(const BoardData& board, const BoardModel& model);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;
  // Twice the cost.
  double Loss(double const* const* parameters) const;
  // The whitened residuals of all corners (u of all, then v of all) and their derivatives by the
  // image: what Evaluate condenses.
  Eigen::MatrixXd Columns(double const* const* parameters) const;
  // d(image) by one parameter of a block, the image's elements row by row.
  Eigen::VectorXd ImageDerivative(double const* const* parameters, Block block, int index) const;

 private:
  struct Chain;
  void WriteJacobian(const Chain& chain, const GramFactor& factor, Block block,
                     double* jacobian) const;

  BoardGeometry geometry_;
  CornerArrays corners_;
  BoardModel model_;
};

}  // namespace telestrain
