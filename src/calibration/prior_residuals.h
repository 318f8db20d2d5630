#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

// Private to the calibration module: what the adjustment knows beside the corners.
namespace telestrain {

// One residual value / sigma for each parameter of a block whose sigma is positive.
class PriorResidual : public ceres::CostFunction {
 public:
  explicit PriorResidual(const std::vector<double>& sigmas);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::vector<double> sigmas_;
};

// The stage's direction: two small tilts of its start, and the relative error of all its travels.
inline constexpr int kStageSize = 3;
struct StageAxis {
  Eigen::Vector3d start = Eigen::Vector3d::UnitZ();  // unit vector
  Eigen::Vector3d side_x = Eigen::Vector3d::UnitX(), side_y = Eigen::Vector3d::UnitY();
  explicit StageAxis(const Eigen::Vector3d& axis);
  Eigen::Vector3d At(const double* block) const;
};

// Between two poses of one block the target moves by the stage's travel along its direction of
// known sense. Three residuals; parameter blocks: poses (6 each), stage (3).
class StageResidual : public ceres::CostFunction {
 public:
  struct Move {
    int first = 0, second = 0, poses = 0;  // which poses of how many
    double travel_mm = 0, sigma_mm = 1;
  };
  StageResidual(const StageAxis& axis, const Move& move);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  StageAxis axis_;
  Move move_;
};

}  // namespace telestrain
