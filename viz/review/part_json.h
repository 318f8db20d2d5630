#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viz/scene/part.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// The scene for the page, all that review.js reads:
//   layers       key, name, shown at first; those that have parts
//   states       text of every pipe state; first_state
//   directions   name, towards_viewer, up: the standard views; unit vectors
//   labels       text, layer, state, at (mm), color
//   quantities   key, name, unit, color_map, scale, state_scales (one per state; empty when the
//                quantity does not depend on the state); a scale has low, high, ticks, decimals,
//                clipped
//   legends      layer, name, scale, colors (256, hex): what the colours of boards and rulers mean
//   color_maps   256 hex colours by name
//   parts        name, layer, state (-1: every one), color, opacity, line_width_pt, lit, facts
//                [name, value], and as Base64 of little-endian numbers: points (float32, x y z,
//                mm), faces (uint32: count, indexes, count, …), lines (uint32, pairs), values
//                (float32 per point, by quantity key)
// Points are in the array frame. float32 rounds them by less than 2 nm within 30 mm.
nlohmann::ordered_json SceneJson(const Scene& scene, const PartList& list);

}  // namespace telestrain::viz
