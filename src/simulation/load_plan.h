#pragma once

#include <vector>

#include "simulation/experiment_truth.h"

namespace telestrain {

// The pipe's history: the reference state, then `load_cycles` cycles up to the full load and back
// to none, moved rigidly in every state. Tension, bending, torsion, pressure and temperature grow
// together with the load. Gauges along the pipe sit at 0, 90, 180 and 270 deg around it, so that
// their mean is the uniform axial strain; they read thermal expansion too (apparent strain).
std::vector<PipeTruth> PlanLoads(const VirtualExperimentOptions& options, const PipeSpec& pipe);

// Strains that an ideal four-view array would report, relative to the reference state, averaged
// over the arc that both views of a group see (32 deg to either side on 8 mm).
struct TrueStrain {
  // Change of the distance between the middles of the patches' midlines: the strain of the material
  // line between them, torsion's lean of gamma^2 / 2 included.
  double long_base = 0;
  double local_a = 0, local_b = 0;
  double hoop = 0, shear = 0;  // of the surface, mean of both patches; the reference has no load
};
TrueStrain StrainOf(const DeformedPipe& state, const DeformedPipe& reference, double patch_a_x_mm,
                    double patch_b_x_mm);
// Of one state of the experiment against its first, between the patches that the groups see.
TrueStrain StrainOf(const ExperimentTruth& truth, const PipeTruth& state);

}  // namespace telestrain
