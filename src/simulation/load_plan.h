#pragma once

#include <vector>

#include "simulation/experiment_truth.h"

namespace telestrain {

// The pipe's history: the reference state, then `load_cycles` cycles up to the full load and back
// to none, moved rigidly in every state. Bending grows with the load. Gauges sit at 0, 90, 180 and
// 270 deg around the pipe, so that their mean is the membrane strain.
std::vector<PipeTruth> PlanLoads(const VirtualExperimentOptions& options, const PipeSpec& pipe);

// Strains that an ideal four-view array would report, relative to the reference state, averaged
// over the arc that both views of a group see (32 deg to either side).
struct TrueStrain {
  double long_base = 0;  // change of the distance between the patch midlines along the pipe
  double local_a = 0, local_b = 0;
};
TrueStrain StrainOf(const DeformedPipe& state, const DeformedPipe& reference, double patch_a_x_mm,
                    double patch_b_x_mm);

}  // namespace telestrain
