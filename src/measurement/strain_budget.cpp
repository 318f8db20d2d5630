#include "measurement/strain_budget.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "measurement/spread_sample.h"

namespace telestrain {
namespace {

using Entry = StrainResults::Entry;
using Groups = std::vector<std::vector<std::size_t>>;

// Smooth effects (calibration, bias) are carried through this many points of every patch.
constexpr std::size_t kSampledPoints = 80;

Groups Sampled(const Groups& index_of_group) {
  Groups sampled;
  for (const auto& index : index_of_group) {
    sampled.emplace_back();
    for (const std::size_t k : SpreadSample(index.size(), kSampledPoints))
      sampled.back().push_back(index[k]);
  }
  return sampled;
}

// Displacement per pixel of the four image coordinates of a pair (first x, y, second x, y), mm;
// the same over the patch to the lens's distortion.
Eigen::Matrix<double, 3, 4> DisplacementPerPixel(const ArrayCalibration& array,
                                                 const TrackedPoint& point) {
  const auto& [first, second] = point.measured;
  const Eigen::Vector3d at = Triangulate(array, {first, second}).in_array_mm;
  Eigen::Matrix<double, 3, 4> per_pixel;
  for (int coordinate = 0; coordinate < 4; ++coordinate) {
    std::vector<ViewMeasurement> moved{first, second};
    moved[static_cast<std::size_t>(coordinate / 2)].pixel(coordinate % 2) += 1;
    per_pixel.col(coordinate) = Triangulate(array, moved).in_array_mm - at;
  }
  return per_pixel;
}

double Shift_px(const PipePoint& point, const TrackedPoint& tracked, int coordinate) {
  const int axis = coordinate % 2;
  return coordinate < 2 ? tracked.measured[0].pixel(axis) - point.first_center_px(axis)
                        : tracked.measured[1].pixel(axis) - point.second_pixel(axis);
}

Eigen::VectorXd BiasOfStrain(const StateInput& input, const std::vector<DisplacedPoint>& points,
                             const Groups& sampled, const BeamState::Vector& start) {
  // Mean square of b sin(phase): b rectangular up to the bound, the phase unknown.
  const double amplitude_px = kCorrelationBias_px / std::sqrt(6.0);
  const Eigen::VectorXd middle = EvaluateStrain(input.model, points, sampled, start).value;
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(middle.size());
  for (const auto& index : sampled) {
    const auto per_pixel = DisplacementPerPixel(input.array, input.tracked[index.front()]);
    for (int source = 0; source < 8; ++source) {  // a coordinate, sine or cosine
      const int coordinate = source / 2;
      std::vector<DisplacedPoint> biased = points;
      for (const std::size_t i : index) {
        const double phase =
            2 * std::numbers::pi * Shift_px(input.grid.points[i], input.tracked[i], coordinate);
        const double wave = source % 2 == 0 ? std::sin(phase) : std::cos(phase);
        biased[i].displacement_mm += amplitude_px * wave * per_pixel.col(coordinate);
      }
      variance += (EvaluateStrain(input.model, biased, sampled, start).value - middle)
                      .array()
                      .square()
                      .matrix();
    }
  }
  return variance.cwiseSqrt();
}

CalibrationCovariances CalibrationOfStrain(const StateInput& input, const Groups& sampled,
                                           const BeamState::Vector& start) {
  std::vector<DisplacedPoint> points(input.grid.points.size());
  return CalibrationPartsOf(input.array, [&](const ArrayCalibration& perturbed) {
    for (const auto& index : sampled)
      for (const std::size_t i : index)
        points[i] = Locate(perturbed, input.grid, input.grid.points[i], input.tracked[i]).point;
    return EvaluateStrain(input.model, points, sampled, start).value;
  });
}

// How far off the axis each entry's fibre matters: bending times the uncertainty of its place.
Eigen::VectorXd FibreOfStrain(const StrainModel& model, const StrainResults& results) {
  const BeamState& beam = results.beam;
  const double g0 = beam.value(BeamState::kSlope0), g90 = beam.value(BeamState::kSlope90);
  const double sigma_g0 = std::sqrt(beam.covariance(BeamState::kSlope0, BeamState::kSlope0));
  const double sigma_g90 = std::sqrt(beam.covariance(BeamState::kSlope90, BeamState::kSlope90));
  const double of_axis = std::hypot(g0, g90) * model.sigma_axis_mm;
  const auto reach = [&](const Eigen::Vector2d& to_fibre_mm) {
    return std::hypot(of_axis, sigma_g90 * to_fibre_mm.x(), sigma_g0 * to_fibre_mm.y());
  };
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(results.value.size());
  sigma(Entry::kLongBase) = reach(LongBaseToFibre_mm(model, results.patches));
  sigma(Entry::kMembrane) = of_axis;
  sigma(Entry::kBending0) = std::abs(g0) * model.sigma_axis_mm;
  sigma(Entry::kBending90) = std::abs(g90) * model.sigma_axis_mm;
  sigma(Entry::kTorsion) = std::abs(beam.value(BeamState::kTwist)) * model.sigma_axis_mm;
  const auto groups = static_cast<Eigen::Index>(results.patches.size());
  for (Eigen::Index g = 0; g < groups; ++g)
    sigma(Entry::kFirstLocal + g) = reach(
        ToFibre_mm(model, results.patches[static_cast<std::size_t>(g)].field.center_in_array_mm));
  for (std::size_t i = 0; i < model.gauges.size(); ++i) {
    const PipeGauge& gauge = model.gauges[i];
    const double per_radian =
        model.shape.radius_mm * (g90 * std::cos(gauge.angle_rad) - g0 * std::sin(gauge.angle_rad));
    sigma(Entry::kFirstLocal + groups + static_cast<Eigen::Index>(i)) =
        std::hypot(of_axis, per_radian * gauge.sigma_angle_rad);
  }
  return sigma;
}

}  // namespace

LocatedPoint Locate(const ArrayCalibration& array, const PipeGrid& grid, const PipePoint& point,
                    const TrackedPoint& tracked) {
  const StereoPair& pair = grid.pairs[static_cast<std::size_t>(point.group)];
  const TriangulatedPoint before = Triangulate(
      array, {{pair.first, point.first_center_px.cast<double>(), Eigen::Matrix2d::Zero()},
              {pair.second, point.second_pixel, Eigen::Matrix2d::Zero()}});
  const TriangulatedPoint after = Triangulate(array, {tracked.measured[0], tracked.measured[1]});
  return {{before.in_array_mm, after.in_array_mm - before.in_array_mm, after.covariance_mm2},
          std::abs(after.residual_px - before.residual_px)};
}

std::vector<StrainValue> StrainWithBudgets(const StateInput& input,
                                           const std::vector<DisplacedPoint>& points,
                                           const Groups& index_of_group,
                                           const StrainResults& results) {
  const Groups sampled = Sampled(index_of_group);
  const BeamState::Vector& start = results.beam.value;
  const Eigen::VectorXd noise = NoiseOfStrain(input.model, points, results);
  const Eigen::VectorXd bias = BiasOfStrain(input, points, sampled, start);
  const CalibrationCovariances calibration = CalibrationOfStrain(input, sampled, start);
  const Eigen::VectorXd fibre = FibreOfStrain(input.model, results);
  std::vector<StrainValue> values;
  for (Eigen::Index i = 0; i < results.value.size(); ++i) {
    StrainValue value{results.value(i),
                      0,
                      {{"image noise", noise(i)},
                       {"correlation bias", bias(i)},
                       {"calibration", Sigma(calibration.noise, i)},
                       {"target certificate", Sigma(calibration.certificate, i)},
                       {"fibre", fibre(i)}}};
    value.standard_uncertainty = Combine(value.budget);
    values.push_back(std::move(value));
  }
  return values;
}

}  // namespace telestrain
