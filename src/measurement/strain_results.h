#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "measurement/beam_fit.h"
#include "measurement/patch_field.h"
#include "measurement/strain_model.h"

namespace telestrain {

// All strains of one state as one vector, so that every source of uncertainty is carried through
// to all of them at once. Plain ratios.
struct StrainResults {
  enum Entry {
    kLongBase = 0,
    kMembrane,
    kBending0,   // added at the outer fibre at 0 degrees (it faces the instrument)
    kBending90,  // at 90 degrees
    kTorsion,    // shear of the surface, R times the twist
    kAcross,     // uniform strain across the pipe: Poisson contraction, pressure, heat
    kFirstLocal  // then the local axial strain of every group, then every gauge
  };
  Eigen::VectorXd value;
  std::vector<PatchFit> patches;  // one per group
  BeamState beam;
};

// The two ends of the base: the patch centres, brought to their common line along the pipe.
std::array<Eigen::Vector3d, 2> BaseEnds(const Eigen::Vector3d& axis, const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b);

// Sideways distance (mm; towards 90 and 0 degrees) of the fibre that a value refers to from the
// middle of the points it was measured on.
Eigen::Vector2d ToFibre_mm(const StrainModel& model, const Eigen::Vector3d& middle_in_array_mm);

// The same of the long base: the mean of its two patches.
Eigen::Vector2d LongBaseToFibre_mm(const StrainModel& model, const std::vector<PatchFit>& patches);

// Evaluates the state from the points of every group (MODEL.md Eq. 15 to 18). The beam starts from
// `start`; result.beam.ok says whether the points determine it.
StrainResults EvaluateStrain(const StrainModel& model, const std::vector<DisplacedPoint>& points,
                             const std::vector<std::vector<std::size_t>>& index_of_group,
                             const BeamState::Vector& start = BeamState::Vector::Zero());

// Standard deviations of the entries from the noise of the points.
Eigen::VectorXd NoiseOfStrain(const StrainModel& model, const std::vector<DisplacedPoint>& points,
                              const StrainResults& results);

}  // namespace telestrain
