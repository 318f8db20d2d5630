#pragma once

#include <string>
#include <vector>

#include "optics/rig_design.h"

namespace telestrain {

// A design as tables for a person: lines of aligned columns, units in the headings, ASCII.
std::vector<std::string> DesignTables(const OpticalRig& rig, const RigDesign& design);

// Everything of a design for a program, as JSON text of the schema "telestrain.design/1"; units in
// the keys, the array frame, and every plate's corners.
std::string DesignJson(const OpticalRig& rig, const RigDesign& design);

}  // namespace telestrain
