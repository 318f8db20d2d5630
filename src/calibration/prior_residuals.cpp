#include "calibration/prior_residuals.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace telestrain {
namespace {
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr int kPoseSize = 6;
}  // namespace

PriorResidual::PriorResidual(const std::vector<double>& sigmas) : sigmas_(sigmas) {
  set_num_residuals(static_cast<int>(
      std::count_if(sigmas.begin(), sigmas.end(), [](double sigma) { return sigma > 0; })));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(sigmas.size()));
}

bool PriorResidual::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const auto size = static_cast<int>(sigmas_.size());
  const bool want_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
  if (want_jacobian) std::fill_n(jacobians[0], num_residuals() * size, 0.0);
  int row = 0;
  for (int i = 0; i < size; ++i) {
    const double sigma = sigmas_[static_cast<std::size_t>(i)];
    if (!(sigma > 0)) continue;
    residuals[row] = parameters[0][i] / sigma;
    if (want_jacobian) jacobians[0][row * size + i] = 1 / sigma;
    ++row;
  }
  return true;
}

StageAxis::StageAxis(const Eigen::Vector3d& axis)
    : start(axis.normalized()), side_x(start.unitOrthogonal()), side_y(start.cross(side_x)) {}

Eigen::Vector3d StageAxis::At(const double* block) const {
  return (start + side_x * block[0] + side_y * block[1]).normalized();
}

StageResidual::StageResidual(const StageAxis& axis, const Move& move) : axis_(axis), move_(move) {
  set_num_residuals(3);
  *mutable_parameter_block_sizes() = {kPoseSize * move.poses, kStageSize};
}

bool StageResidual::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const double* first = parameters[0] + kPoseSize * move_.first + 3;
  const double* second = parameters[0] + kPoseSize * move_.second + 3;
  const double* stage = parameters[1];
  const Eigen::Vector3d direction = axis_.At(stage);
  const double travel_mm = move_.travel_mm * (1 + stage[2]);
  for (int i = 0; i < 3; ++i)
    residuals[i] = (second[i] - first[i] - direction(i) * travel_mm) / move_.sigma_mm;
  if (jacobians == nullptr) return true;
  if (jacobians[0] != nullptr) {
    Eigen::Map<RowMatrix> rows(jacobians[0], 3, kPoseSize * move_.poses);
    rows.setZero();
    rows.middleCols<3>(kPoseSize * move_.first + 3).diagonal().setConstant(-1 / move_.sigma_mm);
    rows.middleCols<3>(kPoseSize * move_.second + 3).diagonal().setConstant(1 / move_.sigma_mm);
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 3, kStageSize, Eigen::RowMajor>> rows(jacobians[1]);
    const double length = (axis_.start + axis_.side_x * stage[0] + axis_.side_y * stage[1]).norm();
    const Eigen::Matrix3d across =
        (Eigen::Matrix3d::Identity() - direction * direction.transpose()) / length;
    rows.col(0) = -travel_mm / move_.sigma_mm * (across * axis_.side_x);
    rows.col(1) = -travel_mm / move_.sigma_mm * (across * axis_.side_y);
    rows.col(2) = -move_.travel_mm / move_.sigma_mm * direction;
  }
  return true;
}

}  // namespace telestrain
