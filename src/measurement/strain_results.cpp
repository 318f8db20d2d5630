#include "measurement/strain_results.h"

#include <cmath>

namespace telestrain {
namespace {

using Entry = StrainResults::Entry;

double LongBase(const PipeShape& shape, const PatchField& a, const PatchField& b) {
  const auto ends = BaseEnds(shape.along, a.center_in_array_mm, b.center_in_array_mm);
  const double before = (ends[1] - ends[0]).norm();
  const double after = (ends[1] + b.At(ends[1]) - ends[0] - a.At(ends[0])).norm();
  return after / before - 1.0;
}

// The strains of the beam that are linear in its parameters: one row each, membrane to across, then
// the gauges.
Eigen::Matrix<double, Eigen::Dynamic, BeamState::kCount> BeamRows(const StrainModel& model) {
  constexpr int kBeamEntries = Entry::kFirstLocal - Entry::kMembrane;
  const double radius_mm = model.shape.radius_mm;
  Eigen::Matrix<double, Eigen::Dynamic, BeamState::kCount> rows(
      kBeamEntries + static_cast<Eigen::Index>(model.gauges.size()), BeamState::kCount);
  rows.setZero();
  rows(0, BeamState::kMembrane) = 1;
  rows(1, BeamState::kSlope0) = radius_mm;
  rows(2, BeamState::kSlope90) = radius_mm;
  rows(3, BeamState::kTwist) = radius_mm;
  rows(4, BeamState::kAcross) = 1;
  // The curvature is constant along the pipe, so that the mean over a gauge is its middle.
  for (std::size_t i = 0; i < model.gauges.size(); ++i) {
    const auto row = kBeamEntries + static_cast<Eigen::Index>(i);
    rows(row, BeamState::kMembrane) = 1;
    rows(row, BeamState::kSlope0) = radius_mm * std::cos(model.gauges[i].angle_rad);
    rows(row, BeamState::kSlope90) = radius_mm * std::sin(model.gauges[i].angle_rad);
  }
  return rows;
}

// What bending adds between two fibres.
double AcrossFibres(const BeamState& beam, const Eigen::Vector2d& offset_mm) {
  return beam.value(BeamState::kSlope90) * offset_mm.x() +
         beam.value(BeamState::kSlope0) * offset_mm.y();
}

Eigen::Vector3d AlongAt(const PipeShape& shape, const Eigen::Vector3d& in_array_mm) {
  return shape.AxesAt(shape.Straighten(in_array_mm).x()).col(0);
}

}  // namespace

std::array<Eigen::Vector3d, 2> BaseEnds(const Eigen::Vector3d& axis, const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b) {
  const Eigen::Vector3d middle = 0.5 * (a + b);
  const Eigen::Vector3d lateral = middle - axis * axis.dot(middle);
  return {lateral + axis * axis.dot(a), lateral + axis * axis.dot(b)};
}

Eigen::Vector2d ToFibre_mm(const StrainModel& model, const Eigen::Vector3d& middle_in_array_mm) {
  if (!model.fibre_mm) return Eigen::Vector2d::Zero();
  return *model.fibre_mm - model.shape.Straighten(middle_in_array_mm).tail<2>();
}

Eigen::Vector2d LongBaseToFibre_mm(const StrainModel& model, const std::vector<PatchFit>& patches) {
  return 0.5 * (ToFibre_mm(model, patches[0].field.center_in_array_mm) +
                ToFibre_mm(model, patches[1].field.center_in_array_mm));
}

StrainResults EvaluateStrain(const StrainModel& model, const std::vector<DisplacedPoint>& points,
                             const std::vector<std::vector<std::size_t>>& index_of_group,
                             const BeamState::Vector& start) {
  StrainResults results;
  std::vector<std::size_t> all;
  for (const auto& index : index_of_group) {
    results.patches.push_back(FitPatch(points, index));
    all.insert(all.end(), index.begin(), index.end());
  }
  results.beam = FitBeam(model.shape, model.poisson_ratio, points, all, start);
  const auto groups = static_cast<Eigen::Index>(index_of_group.size());
  const Eigen::VectorXd beam = BeamRows(model) * results.beam.value;
  constexpr Eigen::Index kBeamEntries = Entry::kFirstLocal - Entry::kMembrane;
  results.value.resize(1 + groups + beam.size());
  results.value.segment(Entry::kMembrane, kBeamEntries) = beam.head(kBeamEntries);
  results.value.tail(beam.size() - kBeamEntries) = beam.tail(beam.size() - kBeamEntries);
  for (Eigen::Index g = 0; g < groups; ++g) {
    const PatchField& field = results.patches[static_cast<std::size_t>(g)].field;
    const Eigen::Vector3d& center = field.center_in_array_mm;
    results.value(Entry::kFirstLocal + g) = field.FibreStrain(AlongAt(model.shape, center)) +
                                            AcrossFibres(results.beam, ToFibre_mm(model, center));
  }
  results.value(Entry::kLongBase) =
      LongBase(model.shape, results.patches[0].field, results.patches[1].field) +
      AcrossFibres(results.beam, LongBaseToFibre_mm(model, results.patches));
  return results;
}

Eigen::VectorXd NoiseOfStrain(const StrainModel& model, const std::vector<DisplacedPoint>& points,
                              const StrainResults& results) {
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(results.value.size());
  const auto rows = BeamRows(model);
  constexpr Eigen::Index kBeamEntries = Entry::kFirstLocal - Entry::kMembrane;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double variance = rows.row(i) * results.beam.covariance * rows.row(i).transpose();
    const Eigen::Index entry =
        i < kBeamEntries ? Entry::kMembrane + i : sigma.size() - rows.rows() + i;
    sigma(entry) = std::sqrt(std::max(0.0, variance));
  }
  // The scatter of what the beam does not explain: bending is not linear in space, and its rest
  // would pass for noise.
  std::vector<PatchFit> beyond;
  std::vector<DisplacedPoint> rest = points;
  for (const PatchFit& patch : results.patches) {
    rest = BeyondBeam(model.shape, model.poisson_ratio, results.beam.value, rest, patch.index);
    beyond.push_back(FitPatch(rest, patch.index));
  }
  for (std::size_t g = 0; g < beyond.size(); ++g)
    sigma(Entry::kFirstLocal + static_cast<Eigen::Index>(g)) =
        beyond[g].StrainNoise(rest, AlongAt(model.shape, beyond[g].field.center_in_array_mm));
  const Eigen::Vector3d& axis = model.shape.along;
  const PatchFit &a = beyond[0], &b = beyond[1];
  const auto ends = BaseEnds(axis, a.field.center_in_array_mm, b.field.center_in_array_mm);
  sigma(Entry::kLongBase) =
      std::hypot(a.NoiseAt_mm(rest, axis, ends[0]), b.NoiseAt_mm(rest, axis, ends[1])) /
      (ends[1] - ends[0]).norm();
  return sigma;
}

}  // namespace telestrain
