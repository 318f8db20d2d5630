#include "statistical/repeated_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/rotation.h"

namespace telestrain::testing_support {
namespace {

constexpr int kMagnificationIndex = 0, kDistortionIndex = 1;
constexpr int kViewParameters = 5;

SyntheticArray MakeTruth(const RepeatOptions& options) {
  SyntheticOptions synthetic;
  synthetic.poses = 5;
  synthetic.noise_px = options.noise_px;
  synthetic.k1_per_mm2 = 1e-4;  // large enough that the model choice never leaves it out
  SyntheticArray array = MakeSyntheticArray(synthetic);
  array.session.target.sigma_square_um = 0;
  array.session.target.sigma_separation_um = options.sigma_separation_um;
  array.session.target.coplanarity_um = 0;
  array.session.ruler.sigma_length_um = options.sigma_length_um;
  array.session.ruler_images = {"ruler.png"};
  return array;
}

Eigen::Vector3d NormalVector(double sigma, Random& random) {
  const double x = random.Normal(sigma), y = random.Normal(sigma), z = random.Normal(sigma);
  return {x, y, z};
}

// Observes all boards afresh, with another stage travel and another true board separation.
void ObserveBoards(const RepeatOptions& options, Random& random, SyntheticArray& array) {
  TargetSpec target = array.session.target;
  target.boards[1].center_in_target_mm.x() += random.Normal(options.sigma_separation_um / 1000);
  std::vector<TargetPose> poses = array.poses;
  for (std::size_t k = 1; k < poses.size(); k += 2)
    poses[k].origin_in_array_mm += NormalVector(array.session.stage_sigma_mm, random);
  for (std::size_t b = 0; b < array.boards.size(); ++b) {
    const std::size_t view = b % array.views.size();
    const TargetPose& pose = poses[b / array.views.size()];
    const SubBoard* board = target.FindBoard(array.views[view].group);
    const Eigen::Matrix3Xd corners = target.CornersInTarget(*board);
    for (Eigen::Index i = 0; i < corners.cols(); ++i)
      array.boards[b].corners[static_cast<std::size_t>(i)] =
          Observe(array, view, pose.array_from_target * corners.col(i) + pose.origin_in_array_mm,
                  options.noise_px, random);
  }
}

// The crosses of a ruler of true length nominal + error, somewhere in the fields.
std::vector<CrossObservation> ObserveRuler(const RepeatOptions& options, double error_um,
                                           Random& random, const SyntheticArray& array) {
  const double length_mm = array.session.ruler.length_mm + error_um / 1000;
  const Eigen::Vector3d middle(random.Uniform(-0.3, 0.3), random.Uniform(-0.5, 0.5),
                               random.Uniform(-0.8, 0.2));
  const double yaw = random.Uniform(-0.02, 0.02), pitch = random.Uniform(-0.02, 0.02);
  const Eigen::Vector3d direction = Eigen::Vector3d(1, yaw, pitch).normalized();
  std::vector<CrossObservation> crosses;
  for (std::size_t v = 0; v < array.views.size(); ++v) {
    const double side = array.views[v].group == "A" ? -0.5 : 0.5;
    crosses.push_back(
        {"ruler.png",
         array.views[v].name,
         Observe(array, v, middle + side * length_mm * direction, options.noise_px, random),
         {}});
  }
  return crosses;
}

StatedError ErrorOf(double found, double truth, const Eigen::MatrixXd& covariance, int index) {
  return {found - truth, std::sqrt(covariance(index, index))};
}

// Rotation of view `j` relative to the first view: free of the gauge. With R' = Exp(w) R for both,
// R_j R_0^T moves by w_j - R_j R_0^T w_0 to first order.
void AddRelativeRotation(const SyntheticArray& truth, const ArrayCalibration& found, std::size_t j,
                         RepeatedCalibrations& all) {
  const Eigen::Matrix3d j_from_0 =
      found.views[j].Rotation() * found.views[0].Rotation().transpose();
  const Eigen::Matrix3d true_j_from_0 =
      truth.views[j].Rotation() * truth.views[0].Rotation().transpose();
  const Eigen::Vector3d error = LogRotation(j_from_0 * true_j_from_0.transpose());
  const Eigen::MatrixXd& c = found.covariance;
  const int at_0 = found.model.Count() * static_cast<int>(found.lenses.size());
  const int at_j = at_0 + kViewParameters * static_cast<int>(j);
  const Eigen::Matrix3d cross = c.block<3, 3>(at_j, at_0) * j_from_0.transpose();
  const Eigen::Matrix3d cov = c.block<3, 3>(at_j, at_j) - cross - cross.transpose() +
                              j_from_0 * c.block<3, 3>(at_0, at_0) * j_from_0.transpose();
  for (int axis = 0; axis < 3; ++axis)
    all.errors["rotation " + found.views[j].name + " " + "xyz"[axis]].push_back(
        {error(axis), std::sqrt(cov(axis, axis))});
}

void AddCalibration(const SyntheticArray& truth, const Calibration& calibration,
                    RepeatedCalibrations& all) {
  const ArrayCalibration& found = calibration.bundle.state.array;
  ASSERT_TRUE(found.model.distortion[0] && !found.model.aspect);  // k1 stands at its index
  all.richer_models += ToText(found.model) != "k1";
  all.errors["magnification"].push_back(ErrorOf(found.lenses.front().magnification_px_per_mm,
                                                truth.lens.magnification_px_per_mm,
                                                found.covariance, kMagnificationIndex));
  all.errors["k1"].push_back(ErrorOf(found.lenses.front().distortion[0], truth.lens.distortion[0],
                                     found.covariance, kDistortionIndex));
  for (std::size_t j = 1; j < found.views.size(); ++j) AddRelativeRotation(truth, found, j, all);
  const BundleResult& bundle = calibration.bundle;
  all.residuals = bundle.residual_count;
  all.parameters = bundle.parameter_count;
  all.freedom = all.residuals - all.parameters;
  all.chi2_per_freedom.push_back(bundle.chi2 / all.freedom);
  all.rms_px.push_back(calibration.all.rms_px);
}

}  // namespace

RepeatedCalibrations RepeatCalibration(const RepeatOptions& options) {
  SyntheticArray array = MakeTruth(options);
  RepeatedCalibrations all;
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    Random random(1000 + static_cast<std::uint64_t>(repeat) * 7919);
    ObserveBoards(options, random, array);
    const auto calibration = Calibrate(array.session, array.boards);
    if (!calibration) {
      ADD_FAILURE() << calibration.error().message;
      return all;
    }
    AddCalibration(array, *calibration, all);
    const double true_error_um = random.Normal(options.sigma_length_um);
    const auto crosses = ObserveRuler(options, true_error_um, random, array);
    const auto lengths = MeasureRuler(array.session, calibration->bundle.state.array, crosses);
    // The certificate says the nominal length; what it is wrong by is part of the stated error.
    all.errors["ruler length"].push_back(
        {lengths.at(0).error_um, lengths.at(0).standard_uncertainty_um});
  }
  return all;
}

}  // namespace telestrain::testing_support
