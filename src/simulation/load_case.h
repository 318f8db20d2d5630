#pragma once

#include "session/session.h"
#include "simulation/deformed_pipe.h"
#include "simulation/virtual_experiment.h"

namespace telestrain {

// Strains of the outer surface of a thick-walled pipe under internal pressure whose ends are
// closed. With S = p a^2 / (b^2 - a^2) (inner and outer radius a, b) the stresses there are S along
// the axis and 2 S around it (Lame), hence the strains S (1 - 2 n) / E and S (2 - n) / E.
struct PressureStrains {
  double axial = 0, hoop = 0;
};
PressureStrains PressureStrainsAtSurface(const VirtualExperimentOptions& options,
                                         const PipeSpec& spec, double pressure_mpa);

// The pipe of `spec` under this share (0 to 1) of all of the options' loads, not moved yet.
DeformedPipe PipeUnderLoad(const VirtualExperimentOptions& options, const PipeSpec& spec,
                           double load_share);

}  // namespace telestrain
