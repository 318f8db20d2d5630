#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measurement/pipe_geometry.h"
#include "measurement/pipe_points.h"
#include "measurement/pipe_shape.h"
#include "session/session.h"

namespace telestrain {

// What the analysis of every state needs to know about the pipe; made once from the reference.
struct StrainModel {
  PipeShape shape;
  double poisson_ratio = 0.3;  // of the anticlastic part of the bending; the rest is estimated
  // Standard uncertainty of the place of the pipe's axis, which is the place of every fibre.
  double sigma_axis_mm = 0;
  // Across the pipe (towards 90 degrees, towards 0; mm from the axis): the fibre that the long-base
  // and the local strain refer to. Not there: the middle of the points used.
  std::optional<Eigen::Vector2d> fibre_mm;
  std::vector<PipeGauge> gauges;
  double thermal_expansion_per_k = 0;
  double sigma_thermal_expansion_per_k = 0;
  double sigma_temperature_k = 0;
  // Points further than this from the array's focus plane, along the bisector of their two views,
  // are not used: half the depth of field. Not there: no limit.
  std::optional<double> half_depth_of_field_mm;
};

// From the grid alone: its cylinder, a straight pipe, no gauges and no limits.
StrainModel MakeStrainModel(const PipeGrid& grid);

// The same with the pipe as it was measured and what the session says about it. The fibre is the
// mean over the arc that both nominal views of a group see of the nominal pipe which touches the
// middle of their fields: the same for every state and every position of the pipe.
StrainModel MakeStrainModel(const Session& session, const PipeGrid& grid,
                            const PipeGeometry& geometry);

// Mean distance from the axis towards the instrument (mm) over that arc, for the first group.
// Nothing when the two views see no common arc.
std::optional<double> MeanFibre_mm(const Session& session);

}  // namespace telestrain
