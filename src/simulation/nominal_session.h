#pragma once

#include "session/session.h"
#include "simulation/virtual_experiment.h"

namespace telestrain {

// The array's drawing: what the session file says about instrument, target, ruler and pipe, without
// any image yet.
//
// The array frame has x along the pipe, z up to the instrument and its origin on the pipe's upper
// surface line. The camera looks down on four small mirrors; each of the four paths is folded
// outwards, sideways and down onto its patch (design: measurement-model.md, 13). Group A lies at
// x = -13.85 mm, B at +13.85 mm; the two views of a group are inclined by 30 deg to either side.
Session NominalSession(const VirtualExperimentOptions& options);

// The ruler as a target: two crosses of 2 x 2 squares, their saddles `length_mm` apart.
TargetSpec RulerAsTarget(const TargetSpec& target, double length_mm);

}  // namespace telestrain
