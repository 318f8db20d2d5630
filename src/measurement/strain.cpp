#include "measurement/strain.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr int kMinPatchPoints = 8;
constexpr double kOutlierSigmas = 5.0;
constexpr double kOutlierFloor_mm = 5e-4;  // below it a deviation is no outlier but real strain
constexpr double kMaxEpipolarChange_px = 0.3;
// Largest bias of a subset match over the sub-pixel positions, px: measured 0.0002 on soft, 0.0003
// on sharp and 0.0012 on aliased patterns. Enters once per patch as a rectangular distribution.
constexpr double kCorrelationBias_px = 1.2e-3;

// A tracked point with its two positions, in the array of whichever calibration is asked.
struct Pair3d {
  Eigen::Vector3d reference_mm, displacement_mm;
  Eigen::Matrix3d covariance_mm2;
  double epipolar_change_px = 0;
};

Pair3d Locate(const ArrayCalibration& array, const PipeGrid& grid, const PipePoint& point,
              const TrackedPoint& tracked) {
  const StereoPair& pair = grid.pairs[static_cast<std::size_t>(point.group)];
  const TriangulatedPoint before = Triangulate(
      array, {{pair.first, point.first_center_px.cast<double>(), Eigen::Matrix2d::Zero()},
              {pair.second, point.second_pixel, Eigen::Matrix2d::Zero()}});
  const TriangulatedPoint after = Triangulate(array, {tracked.measured[0], tracked.measured[1]});
  return {before.in_array_mm, after.in_array_mm - before.in_array_mm, after.covariance_mm2,
          std::abs(after.residual_px - before.residual_px)};
}

using Design = Eigen::Matrix<double, Eigen::Dynamic, 4>;

struct PatchFit {
  PatchField field;
  Design design;                   // rows of the points used
  std::vector<std::size_t> index;  // of the points used
  Eigen::MatrixXd inverse;         // pseudo-inverse of the design, 4 x n
};

PatchFit FitPatch(const std::vector<Pair3d>& located, const std::vector<std::size_t>& index) {
  PatchFit fit;
  fit.index = index;
  const auto count = static_cast<Eigen::Index>(index.size());
  for (const std::size_t i : index)
    fit.field.center_in_array_mm += located[i].reference_mm / static_cast<double>(count);
  fit.design.resize(count, 4);
  Eigen::MatrixX3d displacements(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Pair3d& point = located[index[static_cast<std::size_t>(k)]];
    fit.design.row(k) << 1.0, (point.reference_mm - fit.field.center_in_array_mm).transpose();
    displacements.row(k) = point.displacement_mm.transpose();
  }
  fit.inverse = fit.design.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::Matrix<double, 4, 3> solution = fit.inverse * displacements;
  fit.field.displacement_mm = solution.row(0).transpose();
  fit.field.gradient = solution.bottomRows<3>().transpose();
  fit.field.points = static_cast<int>(count);
  return fit;
}

double Deviation_mm(const PatchField& field, const Pair3d& point) {
  return (point.displacement_mm - field.At(point.reference_mm)).norm();
}

// Fits the patch of one group and takes out what does not move with it.
Result<PatchFit> FitPatchRobustly(const PipeGrid& grid, int group,
                                  const std::vector<Pair3d>& located, StateStrain& state) {
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < grid.points.size(); ++i)
    if (grid.points[i].group == group && state.points[i].used) index.push_back(i);
  for (;;) {  // every round takes points out or ends
    if (index.size() < kMinPatchPoints)
      return EstimationFailed(
          "group '" + grid.pairs[static_cast<std::size_t>(group)].group + "': only " +
          std::to_string(index.size()) + " points could be followed, at least " +
          std::to_string(kMinPatchPoints) +
          " are needed; the pipe moved out of the field or the pattern changed");
    PatchFit fit = FitPatch(located, index);
    std::vector<double> deviations;
    for (const std::size_t i : index) deviations.push_back(Deviation_mm(fit.field, located[i]));
    std::vector<double> sorted = deviations;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double limit = std::max(kOutlierFloor_mm, kOutlierSigmas * sorted[sorted.size() / 2]);
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < index.size(); ++k) {
      if (deviations[k] <= limit) {
        kept.push_back(index[k]);
        continue;
      }
      state.points[index[k]].used = false;
      ++state.points_rejected["does not move with its patch"];
    }
    if (kept.size() == index.size()) return fit;
    index = std::move(kept);
  }
}

// The two ends of the base: the patch centres, brought to their common line along the pipe.
std::array<Eigen::Vector3d, 2> BaseEnds(const Eigen::Vector3d& axis, const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b) {
  const Eigen::Vector3d middle = 0.5 * (a + b);
  const Eigen::Vector3d lateral = middle - axis * axis.dot(middle);
  return {lateral + axis * axis.dot(a), lateral + axis * axis.dot(b)};
}

double LongBaseStrain(const Eigen::Vector3d& axis, const PatchField& a, const PatchField& b) {
  const auto ends = BaseEnds(axis, a.center_in_array_mm, b.center_in_array_mm);
  const double before = (ends[1] - ends[0]).norm();
  const double after = (ends[1] + b.At(ends[1]) - ends[0] - a.At(ends[0])).norm();
  return after / before - 1.0;
}

double LongBaseStrainOf(const ArrayCalibration& array, const PipeGrid& grid,
                        const std::vector<TrackedPoint>& tracked, const PatchFit& a,
                        const PatchFit& b) {
  std::vector<Pair3d> located(grid.points.size());
  for (const PatchFit* fit : {&a, &b})
    for (const std::size_t i : fit->index)
      located[i] = Locate(array, grid, grid.points[i], tracked[i]);
  return LongBaseStrain(grid.pipe.axis, FitPatch(located, a.index).field,
                        FitPatch(located, b.index).field);
}

// Noise of the patch's displacement along `axis` at `position`, mm: the larger of what the matches
// predict and what the scatter about the field shows.
double NoiseAt_mm(const PatchFit& fit, const std::vector<Pair3d>& located,
                  const Eigen::Vector3d& axis, const Eigen::Vector3d& position) {
  Eigen::Vector4d basis;
  basis << 1.0, position - fit.field.center_in_array_mm;
  const Eigen::VectorXd weights = fit.inverse.transpose() * basis;
  double predicted = 0, scatter = 0;
  for (std::size_t k = 0; k < fit.index.size(); ++k) {
    const Pair3d& point = located[fit.index[k]];
    const double w = weights(static_cast<Eigen::Index>(k));
    predicted += w * w * axis.dot(point.covariance_mm2 * axis);
    scatter += std::pow(axis.dot(point.displacement_mm - fit.field.At(point.reference_mm)), 2);
  }
  const double freedom = std::max(1.0, static_cast<double>(fit.index.size()) - 4);
  return std::sqrt(std::max(predicted, weights.squaredNorm() * scatter / freedom));
}

// Standard deviation of the patch's own strain along the axis.
double LocalSigma(const PatchFit& fit, const std::vector<Pair3d>& located,
                  const Eigen::Vector3d& axis) {
  Eigen::Vector4d basis;
  basis << 0.0, axis;
  const Eigen::VectorXd weights = fit.inverse.transpose() * basis;
  double variance = 0;
  for (std::size_t k = 0; k < fit.index.size(); ++k) {
    const double w = weights(static_cast<Eigen::Index>(k));
    variance += w * w * axis.dot(located[fit.index[k]].covariance_mm2 * axis);
  }
  return std::sqrt(variance);
}

void FillRigidMotion(const std::vector<Pair3d>& located, const PipeGrid& grid, StateStrain& state) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero(), moved = Eigen::Vector3d::Zero();
  const double count = state.points_used;
  for (std::size_t i = 0; i < located.size(); ++i) {
    if (!state.points[i].used) continue;
    center += located[i].reference_mm / count;
    moved += (located[i].reference_mm + located[i].displacement_mm) / count;
  }
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < located.size(); ++i) {
    if (!state.points[i].used) continue;
    const Eigen::Vector3d before = located[i].reference_mm - center;
    const Eigen::Vector3d after = located[i].reference_mm + located[i].displacement_mm - moved;
    correlation += after * before.transpose();
  }
  const Eigen::Matrix3d rotation = NearestRotation(correlation);
  const Cylinder& pipe = grid.pipe;
  const Eigen::Vector3d middle = pipe.axis_point_mm + pipe.axis * pipe.AxialCoordinate_mm(center);
  state.rotation_rad = LogRotation(rotation);
  state.translation_mm = moved + rotation * (middle - center) - middle;
}

// Axial and hoop strain around one point: the patch's own, plus the slopes of what its grid
// neighbours do beyond the patch's field. The field holds rigid motion exactly, so a turn leaves no
// strain.
void FillPointStrain(const PipeGrid& grid, const std::vector<Pair3d>& located,
                     const PatchField& field, std::size_t i, StateStrain& state) {
  constexpr std::size_t kMinNeighbours = 6;
  const PipePoint& point = grid.points[i];
  const Eigen::Vector3d normal = grid.pipe.Normal(point.reference_in_array_mm);
  const Eigen::Vector3d hoop = grid.pipe.axis.cross(normal);
  std::vector<std::size_t> near;
  for (std::size_t k = 0; k < grid.points.size(); ++k) {
    const PipePoint& other = grid.points[k];
    if (other.group == point.group && state.points[k].used &&
        std::abs(other.column - point.column) <= kGaugeReach_steps &&
        std::abs(other.row - point.row) <= kGaugeReach_steps)
      near.push_back(k);
  }
  PointResult& result = state.points[i];
  result.axial_strain = result.hoop_strain = std::numeric_limits<double>::quiet_NaN();
  if (near.size() < kMinNeighbours) return;
  Eigen::MatrixX3d design(near.size(), 3), moved(near.size(), 3);
  for (std::size_t k = 0; k < near.size(); ++k) {
    const Eigen::Vector3d offset = located[near[k]].reference_mm - point.reference_in_array_mm;
    const auto row = static_cast<Eigen::Index>(k);
    design.row(row) << 1.0, grid.pipe.axis.dot(offset), hoop.dot(offset);
    moved.row(row) =
        (located[near[k]].displacement_mm - field.At(located[near[k]].reference_mm)).transpose();
  }
  const auto solver = design.colPivHouseholderQr();
  if (solver.rank() < 3) return;
  const Eigen::Matrix3d slopes = solver.solve(moved);
  const Eigen::Vector3d& axis = grid.pipe.axis;
  result.axial_strain = (axis + field.gradient * axis + slopes.row(1).transpose()).norm() - 1;
  result.hoop_strain = (hoop + field.gradient * hoop + slopes.row(2).transpose()).norm() - 1;
}

void FillBudget(const ArrayCalibration& array, const PipeGrid& grid,
                const std::vector<TrackedPoint>& tracked, const std::vector<Pair3d>& located,
                const std::array<PatchFit, 2>& fits, StateStrain& state) {
  const Eigen::Vector3d& axis = grid.pipe.axis;
  const auto ends =
      BaseEnds(axis, fits[0].field.center_in_array_mm, fits[1].field.center_in_array_mm);
  const double base_mm = (ends[1] - ends[0]).norm();
  const double noise_mm = std::hypot(NoiseAt_mm(fits[0], located, axis, ends[0]),
                                     NoiseAt_mm(fits[1], located, axis, ends[1]));
  const double bias_mm =
      kCorrelationBias_px / array.Magnification_px_per_mm() / std::sqrt(3.0) * std::sqrt(2.0);
  const CalibrationParts calibration = CalibrationPart(array, [&](const ArrayCalibration& moved) {
    return LongBaseStrainOf(moved, grid, tracked, fits[0], fits[1]);
  });
  state.budget = {{"image noise", noise_mm / base_mm},
                  {"correlation bias", bias_mm / base_mm},
                  {"calibration", calibration.noise},
                  {"target certificate", calibration.certificate}};
  state.standard_uncertainty = Combine(state.budget);
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
                                 const std::vector<TrackedPoint>& tracked) {
  StateStrain state;
  state.points.resize(grid.points.size());
  std::vector<Pair3d> located(grid.points.size());
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    if (!tracked[i].reason.empty()) {
      ++state.points_rejected[tracked[i].reason];
      continue;
    }
    located[i] = Locate(array, grid, grid.points[i], tracked[i]);
    if (located[i].epipolar_change_px > kMaxEpipolarChange_px) {
      ++state.points_rejected["left the epipolar line"];
      continue;
    }
    state.points[i].used = true;
    state.points[i].displacement_mm = located[i].displacement_mm;
    state.points[i].zncc = tracked[i].zncc;
    state.points[i].sigma_um =
        1000 * std::sqrt(grid.pipe.axis.dot(located[i].covariance_mm2 * grid.pipe.axis));
  }
  std::array<PatchFit, 2> fits;
  std::vector<PatchField> fields;
  for (std::size_t group = 0; group < grid.pairs.size(); ++group) {
    TELESTRAIN_ASSIGN_OR_RETURN(PatchFit fit,
                                FitPatchRobustly(grid, static_cast<int>(group), located, state));
    const Eigen::Vector3d hoop =
        grid.pipe.axis.cross(grid.pipe.Normal(fit.field.center_in_array_mm));
    fields.push_back(fit.field);
    state.local_axial_strain.push_back(fit.field.FibreStrain(grid.pipe.axis));
    state.local_hoop_strain.push_back(fit.field.FibreStrain(hoop));
    state.local_sigma = std::max(state.local_sigma, LocalSigma(fit, located, grid.pipe.axis));
    if (group < 2) fits[group] = std::move(fit);
  }
  for (const PointResult& point : state.points) state.points_used += point.used ? 1 : 0;
  for (std::size_t i = 0; i < state.points.size(); ++i)
    if (state.points[i].used)
      FillPointStrain(grid, located, fields[static_cast<std::size_t>(grid.points[i].group)], i,
                      state);
  FillRigidMotion(located, grid, state);
  if (grid.pairs.size() >= 2) {
    state.axial_strain = LongBaseStrain(grid.pipe.axis, fits[0].field, fits[1].field);
    FillBudget(array, grid, tracked, located, fits, state);
  }
  return state;
}

}  // namespace telestrain
