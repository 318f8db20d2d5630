#include "measurement/strain.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "geometry/rotation.h"
#include "measurement/point_strain.h"

namespace telestrain {
namespace {

constexpr std::size_t kMinPatchPoints = 8;
constexpr double kOutlierSigmas = 5.0;
constexpr double kOutlierFloor_mm = 5e-4;  // below it a deviation is no outlier but real strain
constexpr double kMaxEpipolarChange_px = 0.3;

using Groups = std::vector<std::vector<std::size_t>>;

// Distance from the array's focus plane, away from the camera: along the bisector of the pair.
double Depth_mm(const ArrayCalibration& array, const StereoPair& pair,
                const Eigen::Vector3d& in_array_mm) {
  const TelecentricView& first = array.views[static_cast<std::size_t>(pair.first)];
  const TelecentricView& second = array.views[static_cast<std::size_t>(pair.second)];
  return (first.Depth_mm(in_array_mm) + second.Depth_mm(in_array_mm)) /
         (first.ViewingDirection() + second.ViewingDirection()).norm();
}

// Why a located point is not used; empty when it is.
std::string ReasonAgainst(const StateInput& input, const PipePoint& point,
                          const LocatedPoint& located) {
  if (located.epipolar_change_px > kMaxEpipolarChange_px) return "left the epipolar line";
  const auto& limit_mm = input.model.half_depth_of_field_mm;
  const StereoPair& pair = input.grid.pairs[static_cast<std::size_t>(point.group)];
  const Eigen::Vector3d now = located.point.reference_mm + located.point.displacement_mm;
  if (limit_mm && std::abs(Depth_mm(input.array, pair, now)) > *limit_mm)
    return "out of the depth of field";
  return "";
}

std::vector<DisplacedPoint> LocateAll(const StateInput& input, StateStrain& state) {
  const Eigen::Vector3d& axis = input.model.shape.along;
  std::vector<DisplacedPoint> points(input.grid.points.size());
  state.points.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::string reason = input.tracked[i].reason;
    LocatedPoint located;
    if (reason.empty()) {
      located = Locate(input.array, input.grid, input.grid.points[i], input.tracked[i]);
      reason = ReasonAgainst(input, input.grid.points[i], located);
    }
    if (!reason.empty()) {
      ++state.points_rejected[reason];
      continue;
    }
    points[i] = located.point;
    PointResult& result = state.points[i];
    result.used = true;
    result.displacement_mm = points[i].displacement_mm;
    result.zncc = input.tracked[i].zncc;
    result.sigma_um = 1000 * std::sqrt(axis.dot(points[i].covariance_mm2 * axis));
  }
  return points;
}

Error TooFewPoints(const std::string& group, std::size_t found, const StateStrain& state) {
  std::string reasons;
  for (const auto& [reason, count] : state.points_rejected)
    reasons += (reasons.empty() ? " (lost: " : ", ") + std::to_string(count) + " " + reason;
  if (!reasons.empty()) reasons += ")";
  return EstimationFailed(
      "group '" + group + "': only " + std::to_string(found) +
      " points could be followed, at least " + std::to_string(kMinPatchPoints) + " are needed" +
      reasons +
      "; the pipe moved out of the field or the pattern changed: record the image "
      "again, or remove its row from pipe.csv");
}

// The points of one group that move together; takes out what does not.
Result<std::vector<std::size_t>> PatchPoints(const PipeGrid& grid, int group,
                                             const std::vector<DisplacedPoint>& points,
                                             StateStrain& state) {
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < grid.points.size(); ++i)
    if (grid.points[i].group == group && state.points[i].used) index.push_back(i);
  for (;;) {  // every round takes points out or ends
    if (index.size() < kMinPatchPoints)
      return TooFewPoints(grid.pairs[static_cast<std::size_t>(group)].group, index.size(), state);
    const PatchField field = FitPatch(points, index).field;
    std::vector<double> deviations;
    for (const std::size_t i : index)
      deviations.push_back((points[i].displacement_mm - field.At(points[i].reference_mm)).norm());
    std::vector<double> sorted = deviations;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double limit = std::max(kOutlierFloor_mm, kOutlierSigmas * *middle);
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < index.size(); ++k) {
      if (deviations[k] <= limit) {
        kept.push_back(index[k]);
        continue;
      }
      state.points[index[k]].used = false;
      ++state.points_rejected["does not move with its patch"];
    }
    if (kept.size() == index.size()) return kept;
    index = std::move(kept);
  }
}

void FillRigidMotion(const std::vector<DisplacedPoint>& points, const PipeGrid& grid,
                     StateStrain& state) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero(), moved = Eigen::Vector3d::Zero();
  const double count = state.points_used;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!state.points[i].used) continue;
    center += points[i].reference_mm / count;
    moved += (points[i].reference_mm + points[i].displacement_mm) / count;
  }
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!state.points[i].used) continue;
    const Eigen::Vector3d before = points[i].reference_mm - center;
    const Eigen::Vector3d after = points[i].reference_mm + points[i].displacement_mm - moved;
    correlation += after * before.transpose();
  }
  const Eigen::Matrix3d rotation = NearestRotation(correlation);
  const Cylinder& pipe = grid.pipe;
  const Eigen::Vector3d middle = pipe.axis_point_mm + pipe.axis * pipe.AxialCoordinate_mm(center);
  state.rotation_rad = LogRotation(rotation);
  state.translation_mm = moved + rotation * (middle - center) - middle;
}

void FillPatches(const StrainModel& model, const StrainResults& results, StateStrain& state) {
  for (const PatchFit& patch : results.patches) {
    const Eigen::Matrix3d axes =
        model.shape.SurfaceAxes(model.shape.Straighten(patch.field.center_in_array_mm));
    const Eigen::Matrix3d after = axes + patch.field.gradient * axes;
    state.patch_tensors.push_back(TensorOf(after.col(0), after.col(1)));
    state.local_hoop_strain.push_back(state.patch_tensors.back().hoop);
  }
  const Eigen::Vector3d middle = 0.5 * (results.patches[0].field.center_in_array_mm +
                                        results.patches[1].field.center_in_array_mm);
  state.fibre_mm = model.fibre_mm.value_or(model.shape.Straighten(middle).tail<2>());
}

void FillValues(const std::vector<StrainValue>& values, std::size_t groups, StateStrain& state) {
  using Entry = StrainResults::Entry;
  state.axial_strain = values[Entry::kLongBase].value;
  state.standard_uncertainty = values[Entry::kLongBase].standard_uncertainty;
  state.budget = values[Entry::kLongBase].budget;
  state.membrane = values[Entry::kMembrane];
  state.bending_0 = values[Entry::kBending0];
  state.bending_90 = values[Entry::kBending90];
  state.torsion = values[Entry::kTorsion];
  state.across = values[Entry::kAcross];
  for (std::size_t g = 0; g < groups; ++g) {
    state.local_axial_strain.push_back(values[Entry::kFirstLocal + g].value);
    state.local_uncertainty.push_back(values[Entry::kFirstLocal + g].standard_uncertainty);
    state.local_sigma = std::max(
        state.local_sigma, values[Entry::kFirstLocal + g].budget.front().standard_uncertainty);
  }
}

void FillMechanical(const StrainModel& model, std::optional<double> change_k, StateStrain& state) {
  if (!change_k || model.thermal_expansion_per_k == 0) return;
  MechanicalStrain mechanical;
  mechanical.temperature_change_k = *change_k;
  mechanical.thermal_strain = model.thermal_expansion_per_k * *change_k;
  mechanical.sigma_thermal_strain =
      std::hypot(model.thermal_expansion_per_k * std::sqrt(2.0) * model.sigma_temperature_k,
                 *change_k * model.sigma_thermal_expansion_per_k);
  mechanical.axial_strain = state.axial_strain - mechanical.thermal_strain;
  mechanical.standard_uncertainty =
      std::hypot(state.standard_uncertainty, mechanical.sigma_thermal_strain);
  mechanical.membrane_strain = state.membrane.value - mechanical.thermal_strain;
  mechanical.membrane_uncertainty =
      std::hypot(state.membrane.standard_uncertainty, mechanical.sigma_thermal_strain);
  state.mechanical = mechanical;
}

// After FillMechanical. The gauges' values are the last ones.
void FillGauges(const StrainModel& model, const std::vector<StrainValue>& values,
                StateStrain& state) {
  for (std::size_t i = 0; i < model.gauges.size(); ++i) {
    StrainValue value = values[values.size() - model.gauges.size() + i];
    const bool compensated = state.mechanical && !model.gauges[i].reads_thermal_strain;
    if (compensated) value.value -= state.mechanical->thermal_strain;
    value.budget.push_back(
        {"temperature", compensated ? state.mechanical->sigma_thermal_strain : 0.0});
    value.standard_uncertainty = Combine(value.budget);
    state.gauges.push_back({model.gauges[i].column, std::move(value)});
  }
}

}  // namespace

double BaseLength_mm(const PipeGrid& grid) {
  std::array<Eigen::Vector3d, 2> centers{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<int, 2> counts{};
  for (const PipePoint& point : grid.points) {
    if (point.group > 1) continue;
    centers[static_cast<std::size_t>(point.group)] += point.reference_in_array_mm;
    ++counts[static_cast<std::size_t>(point.group)];
  }
  return std::abs(grid.pipe.axis.dot(centers[1] / std::max(1, counts[1]) -
                                     centers[0] / std::max(1, counts[0])));
}

Result<StateStrain> AnalyseState(const ArrayCalibration& array, const PipeGrid& grid,
                                 const std::vector<TrackedPoint>& tracked, const StrainModel& model,
                                 std::optional<double> temperature_change_k) {
  TELESTRAIN_CHECK(grid.pairs.size() >= 2, "the long base needs two groups");
  const StateInput input{array, grid, tracked, model};
  StateStrain state;
  const std::vector<DisplacedPoint> points = LocateAll(input, state);
  Groups index_of_group;
  for (std::size_t group = 0; group < grid.pairs.size(); ++group) {
    TELESTRAIN_ASSIGN_OR_RETURN(index_of_group.emplace_back(),
                                PatchPoints(grid, static_cast<int>(group), points, state));
    state.points_used += static_cast<int>(index_of_group.back().size());
  }
  const StrainResults results = EvaluateStrain(model, points, index_of_group);
  if (!results.beam.ok)
    return EstimationFailed("the " + std::to_string(state.points_used) +
                            " points that could be followed do not determine how the pipe moved "
                            "and bent; they must not lie in a line");
  const std::vector<StrainValue> values = StrainWithBudgets(input, points, index_of_group, results);
  FillValues(values, index_of_group.size(), state);
  FillPatches(model, results, state);
  state.beam_chi2_per_freedom = results.beam.chi2_per_freedom;
  state.beam_misfit_rms_um = 1000 * results.beam.misfit_rms_mm;
  FillMechanical(model, temperature_change_k, state);
  FillGauges(model, values, state);
  FillPointStrains(model.shape, grid, points, results.patches, state.points);
  FillRigidMotion(points, grid, state);
  return state;
}

Result<StateStrain> AnalyseState(const ArrayCalibration& array, const PipeGrid& grid,
                                 const std::vector<TrackedPoint>& tracked) {
  return AnalyseState(array, grid, tracked, MakeStrainModel(grid));
}

}  // namespace telestrain
