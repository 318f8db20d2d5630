#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viz/export/shown_values.h"
#include "viz/scene/part.h"

namespace telestrain::viz {

// The parts as a binary glTF 2.0 file (Khronos Group, "glTF 2.0 Specification", 2021). A root node
// turns the array frame so that +y points to the cameras (glTF's up) and +x stays along the pipe;
// below it stands one node per part with its name and, in `extras`, its layer, state and facts.
// Positions are in metres, single precision (about 1 nm here), in the array frame.
//
// Of parts that only one state shows, those of the shown state. A part that has the shown quantity
// carries its colours (COLOR_0, linear as glTF has it) and the plain numbers as the attribute
// "_" + the key in capitals, unless a point has none. Unlit parts use KHR_materials_unlit, so that
// their colour is exact. Polygons of more than three points become fans: they are taken for convex.
// The same parts give the same bytes.
std::string GlbBytes(const std::vector<Part>& parts, const SceneAxes& axes,
                     const std::optional<ShownValues>& shown);

}  // namespace telestrain::viz
