// Do the stated uncertainties of strain and diameter cover the errors? Monte Carlo without images:
// a pipe is loaded and moved at random, seen by the true instrument, with pixel noise, a biased
// correlation and a calibration that errs as its covariance says.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/rotation.h"
#include "measurement/cylinder_fit.h"
#include "measurement/strain.h"
#include "simulation/deformed_pipe.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::MustCalibrate;
using testing_support::Random;
using testing_support::SyntheticArray;

constexpr int kTrials = 300;
constexpr double kMicro = 1e-6;
constexpr double kNoise_px = 0.004;       // of a tracked coordinate: a subset of 61 px
constexpr double kStereoNoise_px = 0.02;  // of a match across the views
constexpr double kCornerNoise_px = 0.02;
constexpr double kPoisson = 0.31;

struct Trial {
  DeformedPipe reference, state;
  PipeGrid grid;
  std::vector<Eigen::Vector3d> material_mm;  // of the grid's points
  std::vector<TrackedPoint> tracked;
};

// The material point of an unloaded, moved pipe that a pixel shows.
Eigen::Vector3d MaterialSeen(const ArrayCalibration& truth, int view, const Eigen::Vector2d& pixel,
                             const DeformedPipe& pipe) {
  Cylinder cylinder;
  cylinder.axis_point_mm = pipe.origin_in_array_mm;
  cylinder.axis = pipe.array_from_pipe.col(0);
  cylinder.radius_mm = pipe.radius_mm;
  const ImageRay ray = truth.RayOf(view, pixel);
  return pipe.array_from_pipe.transpose() *
         (cylinder.Enter(ray.point_in_array_mm, ray.direction_in_array).value() -
          pipe.origin_in_array_mm);
}

DeformedPipe MovedPipe(Random& random) {
  DeformedPipe pipe;
  pipe.radius_mm = 4;
  pipe.poisson_ratio = kPoisson;
  constexpr double kTurn_rad = 0.2 * std::numbers::pi / 180;
  Eigen::Vector3d turn, shift;
  for (int axis = 0; axis < 3; ++axis) {
    turn(axis) = random.Uniform(-kTurn_rad, kTurn_rad);
    shift(axis) = random.Uniform(-0.15, 0.15);
  }
  pipe.array_from_pipe = ExpRotation(turn);
  pipe.origin_in_array_mm = Eigen::Vector3d(0, 0, -4) + shift;
  return pipe;
}

class Experiment {
 public:
  Experiment() {
    testing_support::SyntheticOptions options;
    options.noise_px = kCornerNoise_px;
    const SyntheticArray synthetic = MakeSyntheticArray(options);
    truth_ = MustCalibrate(synthetic).bundle.state.array;
    factor_ = Eigen::LDLT<Eigen::MatrixXd>(truth_.covariance);
  }
  const ArrayCalibration& truth() const { return truth_; }

  // A calibration that errs as it says.
  ArrayCalibration Estimate(Random& random) const {
    Eigen::VectorXd unit(truth_.ParameterCount());
    for (double& value : unit) value = random.Normal(1);
    const Eigen::VectorXd scaled = factor_.vectorD().cwiseMax(0).cwiseSqrt().cwiseProduct(unit);
    return truth_.Perturbed(factor_.transpositionsP().transpose() *
                            Eigen::VectorXd(factor_.matrixL() * scaled));
  }

  Trial Run(const ArrayCalibration& estimate, Random& random) const {
    Trial trial;
    trial.reference = MovedPipe(random);
    trial.state = MovedPipe(random);
    trial.state.membrane_strain = random.Uniform(0, 750) * kMicro;
    trial.state.curvature_per_mm = random.Uniform(0, 150) * kMicro / 4;
    trial.state.curvature_angle_rad = random.Uniform(-3.14, 3.14);
    trial.state.twist_rad_per_mm = random.Uniform(-100, 100) * kMicro / 4;
    for (int group = 0; group < 2; ++group) {
      const auto axis = [&](std::size_t view) { return truth_.views[view].ViewingDirection(); };
      const auto first = static_cast<std::size_t>(2 * group);
      trial.grid.pairs.push_back(
          {group == 0 ? "A" : "B", 2 * group, 2 * group + 1, axis(first), axis(first + 1)});
      AddPoints(estimate, group, random, trial);
    }
    trial.grid.step_px = 61;
    return trial;
  }

 private:
  void AddPoints(const ArrayCalibration& estimate, int group, Random& random, Trial& trial) const {
    const int first = 2 * group;
    Eigen::Vector4d amplitude, phase;  // of the bias, per view and direction
    for (int i = 0; i < 4; ++i) {
      amplitude(i) = random.Uniform(-kCorrelationBias_px, kCorrelationBias_px);
      phase(i) = random.Uniform(-std::numbers::pi, std::numbers::pi);
    }
    const DeformedPipe nominal = [] {
      DeformedPipe pipe;
      pipe.radius_mm = 4;
      pipe.origin_in_array_mm = {0, 0, -4};
      return pipe;
    }();
    for (int row = 0; row < 9; ++row)
      for (int column = 0; column < 12; ++column) {
        const double angle = (row - 4) * 0.12;
        const Eigen::Vector3d wanted = nominal.InArray(
            nominal.Material((group == 0 ? -13.85 : 13.85) + (column - 5.5) * 0.4, angle));
        PipePoint point;
        point.group = group;
        point.row = row;
        point.column = column;
        point.first_center_px = truth_.Project(first, wanted).array().round().cast<int>();
        const Eigen::Vector3d material =
            MaterialSeen(truth_, first, point.first_center_px.cast<double>(), trial.reference);
        const Eigen::Vector3d before = trial.reference.InArray(material);
        const Eigen::Vector3d after = trial.state.InArray(material);
        point.second_pixel =
            truth_.Project(first + 1, before) +
            Eigen::Vector2d(random.Normal(kStereoNoise_px), random.Normal(kStereoNoise_px));
        point.second_center_px = point.second_pixel.array().round().cast<int>();
        point.reference_in_array_mm =
            Triangulate(estimate,
                        {{first, point.first_center_px.cast<double>(), Eigen::Matrix2d::Zero()},
                         {first + 1, point.second_pixel, Eigen::Matrix2d::Zero()}})
                .in_array_mm;
        TrackedPoint tracked;
        tracked.zncc = 1;
        for (int side = 0; side < 2; ++side) {
          const Eigen::Vector2d shift =
              truth_.Project(first + side, after) - truth_.Project(first + side, before);
          const Eigen::Vector2d at =
              side == 0 ? point.first_center_px.cast<double>() : point.second_pixel;
          Eigen::Vector2d bias;
          for (int axis = 0; axis < 2; ++axis)
            bias(axis) = random.Normal(kNoise_px) +
                         amplitude(2 * side + axis) *
                             std::sin(2 * std::numbers::pi * shift(axis) + phase(2 * side + axis));
          tracked.measured[static_cast<std::size_t>(side)] = {
              first + side, at + shift + bias, kNoise_px * kNoise_px * Eigen::Matrix2d::Identity()};
        }
        trial.material_mm.push_back(material);
        trial.tracked.push_back(tracked);
        trial.grid.points.push_back(point);
      }
  }

  ArrayCalibration truth_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

// Axial strain of the state's fibre through the middle of these material points.
double StrainOfMiddle(const Trial& trial, int group) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double count = 0;
  for (std::size_t i = 0; i < trial.material_mm.size(); ++i) {
    if (group >= 0 && trial.grid.points[i].group != group) continue;
    middle += trial.material_mm[i];
    ++count;
  }
  middle /= count;
  const DeformedPipe& pipe = trial.state;
  return pipe.membrane_strain -
         pipe.curvature_per_mm * (middle.z() * std::cos(pipe.curvature_angle_rad) +
                                  middle.y() * std::sin(pipe.curvature_angle_rad));
}

// Counts how often |error| stays within twice the stated standard uncertainty.
class Coverage {
 public:
  void Add(const std::string& name, double error, double sigma) {
    Entry& entry = entries_[name];
    entry.within += std::abs(error) <= 2 * sigma;
    ++entry.count;
    entry.squares += error * error;
    entry.stated += sigma * sigma;
  }
  struct Entry {
    int within = 0, count = 0;
    double squares = 0, stated = 0;
  };
  const std::map<std::string, Entry>& entries() const { return entries_; }

 private:
  std::map<std::string, Entry> entries_;
};

void AddStrains(const Trial& trial, const StateStrain& found, Coverage& coverage) {
  const DeformedPipe& pipe = trial.state;
  const double bending = -pipe.curvature_per_mm * pipe.radius_mm;
  const auto add = [&](const char* name, const StrainValue& value, double truth) {
    coverage.Add(name, value.value - truth, value.standard_uncertainty);
  };
  add("membrane", found.membrane, pipe.membrane_strain);
  add("bending_0", found.bending_0, bending * std::cos(pipe.curvature_angle_rad));
  add("bending_90", found.bending_90, bending * std::sin(pipe.curvature_angle_rad));
  add("torsion", found.torsion, pipe.twist_rad_per_mm * pipe.radius_mm);
  coverage.Add("long base", found.axial_strain - StrainOfMiddle(trial, -1),
               found.standard_uncertainty);
  for (int group = 0; group < 2; ++group)
    coverage.Add(
        group == 0 ? "local_a" : "local_b",
        found.local_axial_strain[static_cast<std::size_t>(group)] - StrainOfMiddle(trial, group),
        found.local_uncertainty[static_cast<std::size_t>(group)]);
}

TEST(StrainCoverage, StatedExpandedUncertaintiesCoverTheErrors) {
  const Experiment experiment;
  Coverage coverage;
  for (int t = 0; t < kTrials; ++t) {
    Random random(1000 + static_cast<std::uint64_t>(t));
    const ArrayCalibration estimate = experiment.Estimate(random);
    Trial trial = experiment.Run(estimate, random);
    std::vector<Eigen::Vector3d> surface;
    for (const PipePoint& point : trial.grid.points) surface.push_back(point.reference_in_array_mm);
    Cylinder start;
    start.axis_point_mm = {0, 0, -4};
    start.radius_mm = 4;
    const auto cylinder = FitCylinder(surface, start);
    ASSERT_TRUE(cylinder.ok()) << cylinder.error().message;
    trial.grid.pipe = cylinder->cylinder;
    const auto geometry = MeasurePipeGeometry(estimate, trial.grid, 8);
    ASSERT_TRUE(geometry.ok()) << geometry.error().message;
    coverage.Add("diameter", geometry->deviation_um, geometry->standard_uncertainty_um);
    StrainModel model = MakeStrainModel(trial.grid);
    model.shape = geometry->shape;
    model.poisson_ratio = kPoisson;
    model.sigma_axis_mm = 1e-3 * geometry->standard_uncertainty_um / 2;
    const auto found = AnalyseState(estimate, trial.grid, trial.tracked, model);
    ASSERT_TRUE(found.ok()) << found.error().message;
    AddStrains(trial, *found, coverage);
  }
  for (const auto& [name, entry] : coverage.entries()) {
    const double share = static_cast<double>(entry.within) / entry.count;
    std::printf("%-10s %5.1f %% within 2 u; rms error %.4g, rms u %.4g\n", name.c_str(),
                100 * share, std::sqrt(entry.squares / entry.count),
                std::sqrt(entry.stated / entry.count));
    RecordProperty(name, std::to_string(share));
    // The project's bar. Shares of 95.4 % scatter by 1.2 % over 300 trials, three of which fit in.
    EXPECT_GE(share, 0.90) << name;
    EXPECT_LE(share, 0.99) << name;
  }
}

}  // namespace
}  // namespace telestrain
