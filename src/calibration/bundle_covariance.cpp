#include "calibration/bundle_covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/bundle_system.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

BundleInformation Named(const BundleSystem& system) {
  BundleInformation information;
  information.names = system.names;
  const Eigen::MatrixXd solver_from_named = system.named_from_solver.inverse();
  const Eigen::MatrixXd reduced = solver_from_named.transpose() * system.global * solver_from_named;
  information.reduced = 0.5 * (reduced + reduced.transpose());
  const Eigen::VectorXd squared_units = solver_from_named.diagonal().array().square();
  information.priors = system.priors.cwiseProduct(squared_units);
  information.own = system.own.cwiseProduct(squared_units);
  return information;
}

Error Undetermined(const BundleSystem& system) {
  std::string text =
      "the images do not determine the calibration: the information matrix is singular";
  const auto weakest = WeakDirections(Named(system), true, 1);
  if (!weakest.empty()) {
    text += " along a combination of ";
    for (std::size_t i = 0; i < std::min<std::size_t>(3, weakest[0].parts.size()); ++i)
      text += (i == 0 ? "" : ", ") + weakest[0].parts[i].name;
  }
  return EstimationFailed(text + "; add poses with different tilts and positions in every view");
}

// Covariance of some of the global parameters when the others are known. Pivots are judged against
// each parameter's own information before elimination.
Result<Eigen::MatrixXd> InverseOf(const BundleSystem& system,
                                  const std::vector<Eigen::Index>& kept) {
  const Eigen::VectorXd scale = system.own(kept).cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> solver(scale.asDiagonal() * system.global(kept, kept) *
                                           scale.asDiagonal());
  const double smallest = solver.matrixLLT().diagonal().cwiseAbs().minCoeff();
  if (solver.info() != Eigen::Success || !(smallest * smallest > kSingularShare))
    return Undetermined(system);
  const auto size = static_cast<Eigen::Index>(kept.size());
  return Eigen::MatrixXd(scale.asDiagonal() * solver.solve(Eigen::MatrixXd::Identity(size, size)) *
                         scale.asDiagonal());
}

void PoseCovariances(const BundleBlocks& blocks, const BundleSystem& system,
                     const Eigen::MatrixXd& of_globals, BundleCovariance& covariance) {
  covariance.poses.assign(blocks.place_of_image.size(), Eigen::Matrix<double, 6, 6>::Zero());
  for (std::size_t k = 0; k < blocks.place_of_image.size(); ++k) {
    if (k == blocks.gauge_pose) continue;
    const PosePlace& place = blocks.place_of_image[k];
    const GroupSystem& group = system.groups[place.group];
    const Eigen::Index at = kPoseSize * place.slot;
    const auto coupling = group.coupling.middleRows<kPoseSize>(at);
    const Eigen::MatrixXd half = coupling.lazyProduct(of_globals);
    const Eigen::Matrix<double, 6, 6> solver =
        group.block.block<kPoseSize, kPoseSize>(at, at) +
        Eigen::Matrix<double, 6, 6>(half.lazyProduct(coupling.transpose()));
    Eigen::Matrix<double, 6, 6> named = Eigen::Matrix<double, 6, 6>::Identity();
    named.topLeftCorner<3, 3>() =
        LeftJacobian(Eigen::Map<const Eigen::Vector3d>(blocks.groups[place.group].values + at));
    covariance.poses[k] = named * solver * named.transpose();
  }
}

Eigen::MatrixXd Symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

// The mean motion of the poses is `own errors - response * globals`.
struct MeanMotion {
  Eigen::MatrixXd response;  // 6 x globals of the solver
  Eigen::Matrix<double, 6, 6> cov_of_own_errors;
};

MeanMotion MeanMotionOf(const BundleBlocks& blocks, const BundleSystem& system) {
  std::vector<Eigen::MatrixXd> of_groups;  // 6 x numbers of the group's poses
  for (const PoseGroup& group : blocks.groups) {
    Eigen::MatrixXd& motion =
        of_groups.emplace_back(Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(group.Size())));
    for (Eigen::Index at = 0; at < motion.cols(); at += kPoseSize) {
      const Eigen::Map<const Eigen::Vector3d> turn(group.values + at),
          origin(group.values + at + 3);
      motion.block<3, 3>(0, at) = LeftJacobian(turn);
      motion.block<3, 3>(3, at) = Skew(origin) * LeftJacobian(turn);
      motion.block<3, 3>(3, at + 3).setIdentity();
    }
    motion /= static_cast<double>(blocks.place_of_image.size());
  }
  MeanMotion mean{Eigen::MatrixXd::Zero(6, system.global.cols()),
                  Eigen::Matrix<double, 6, 6>::Zero()};
  for (std::size_t g = 0; g < of_groups.size(); ++g) {
    const GroupSystem& group = system.groups[g];
    mean.response += of_groups[g].lazyProduct(group.coupling);
    const Eigen::MatrixXd half = of_groups[g].lazyProduct(group.block);
    mean.cov_of_own_errors += half.lazyProduct(of_groups[g].transpose());
  }
  return mean;
}

}  // namespace

Result<BundleInformation> InformationOf(const CalibrationData& data, const ArrayState& state,
                                        const BundleOptions& options, double sigma0) {
  BundleBlocks blocks(data, state, options);
  TELESTRAIN_ASSIGN_OR_RETURN(const BundleSystem system,
                              EliminatePoses(data, state, options, sigma0, blocks));
  return Named(system);
}

std::vector<WeakDirection> WeakDirections(const BundleInformation& information, bool with_priors,
                                          int count) {
  constexpr double kSmallestShare = 0.01;
  Eigen::MatrixXd reduced = information.reduced;
  Eigen::VectorXd own = information.own;
  if (!with_priors) {
    reduced.diagonal() -= information.priors;
    own -= information.priors;
  }
  // A parameter that no corner depends on has no scale: its row is zero, and so its eigenvalue.
  const Eigen::VectorXd scale = (own.array() > 1e-12 * information.own.array())
                                    .select(own.cwiseAbs().cwiseSqrt().cwiseInverse(), 0.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * reduced *
                                                              scale.asDiagonal());
  std::vector<WeakDirection> weak;
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(count, own.size()); ++k) {
    WeakDirection direction;
    direction.information = std::max(0.0, solver.eigenvalues()(k));
    const Eigen::VectorXd vector = solver.eigenvectors().col(k);
    for (Eigen::Index i = 0; i < own.size(); ++i) {
      const double share = vector(i) * vector(i);
      if (share < kSmallestShare) continue;
      const double sigma = direction.information > kSingularShare
                               ? std::abs(vector(i)) * scale(i) / std::sqrt(direction.information)
                               : std::numeric_limits<double>::infinity();
      direction.parts.push_back({information.names[static_cast<std::size_t>(i)], share, sigma});
    }
    std::stable_sort(direction.parts.begin(), direction.parts.end(),
                     [](const auto& a, const auto& b) { return a.share > b.share; });
    weak.push_back(std::move(direction));
  }
  return weak;
}

// With A the information of the adjusted parameters, B their coupling to the considered ones and S
// the priors' covariance of these: what is adjusted errs by the noise, A^-1, and by -A^-1 B times
// the certificates' errors (Schmidt's consider covariance).
Eigen::MatrixXd JointCovariance(const BundleSystem& system, const Eigen::MatrixXd& noise) {
  const auto& adjusted = system.adjusted;
  const auto& considered = system.considered;
  const Eigen::VectorXd certificate = system.priors(considered).cwiseInverse();
  const Eigen::MatrixXd follow = -noise * system.global(adjusted, considered);
  Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(system.global.rows(), system.global.cols());
  joint(adjusted, adjusted) = noise + follow * certificate.asDiagonal() * follow.transpose();
  joint(adjusted, considered) = follow * certificate.asDiagonal();
  joint(considered, adjusted) = joint(adjusted, considered).transpose().eval();
  joint(considered, considered) = certificate.asDiagonal();
  return joint;
}

Result<BundleCovariance> CovarianceOf(const CalibrationData& data, const ArrayState& state,
                                      const BundleOptions& options, double sigma0) {
  BundleBlocks blocks(data, state, options);
  TELESTRAIN_ASSIGN_OR_RETURN(const BundleSystem system,
                              EliminatePoses(data, state, options, sigma0, blocks));
  TELESTRAIN_ASSIGN_OR_RETURN(const Eigen::MatrixXd noise, InverseOf(system, system.adjusted));
  const Eigen::MatrixXd joint = JointCovariance(system, noise);

  BundleCovariance covariance;
  covariance.names = system.names;
  const Eigen::MatrixXd& named = system.named_from_solver;
  const Eigen::Index n = system.array_size;
  covariance.joint = Symmetric(named * joint * named.transpose());
  covariance.array = covariance.joint.topLeftCorner(n, n);
  covariance.array_of_noise = Symmetric(named.topLeftCorner(n, n) * noise.topLeftCorner(n, n) *
                                        named.topLeftCorner(n, n).transpose());
  PoseCovariances(blocks, system, joint, covariance);
  return covariance;
}

Result<MeanMotionCovariance> CovarianceWithMeanMotion(const CalibrationData& data,
                                                      const ArrayState& state,
                                                      const BundleOptions& options, double sigma0) {
  BundleBlocks blocks(data, state, options);
  TELESTRAIN_ASSIGN_OR_RETURN(const BundleSystem system,
                              EliminatePoses(data, state, options, sigma0, blocks));
  TELESTRAIN_ASSIGN_OR_RETURN(const Eigen::MatrixXd noise, InverseOf(system, system.adjusted));
  const MeanMotion mean = MeanMotionOf(blocks, system);
  const Eigen::Index n = system.array_size;
  Eigen::MatrixXd named_from_globals(n + 6, system.global.cols());
  named_from_globals << system.named_from_solver.topRows(n), -mean.response;
  const auto with_motion = [&](const Eigen::MatrixXd& of_globals) {
    Eigen::MatrixXd cov = named_from_globals * of_globals * named_from_globals.transpose();
    cov.bottomRightCorner<6, 6>() += mean.cov_of_own_errors;
    return Symmetric(cov);
  };
  Eigen::MatrixXd of_noise = Eigen::MatrixXd::Zero(system.global.rows(), system.global.cols());
  of_noise(system.adjusted, system.adjusted) = noise;
  return MeanMotionCovariance{with_motion(JointCovariance(system, noise)), with_motion(of_noise)};
}

}  // namespace telestrain
