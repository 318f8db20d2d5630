#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "viz/scene/color_map.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// The state of the pipe and the quantity on it that are looked at.
struct ShownValues {
  std::size_t state = 0;  // index into Pipe::states
  Quantity quantity;
  ColorScale scale;  // ValueScale over all states
};

// What of the scene is meant by a word for a state (its number from 0, its image or "largest") and
// a quantity's key (empty: the axial strain). Empty when no pipe was measured and nothing is asked
// for. Fails (kUsage) naming what there is, or (kBadInput) without a pipe.
Result<std::optional<ShownValues>> ChooseValues(const Scene& scene, const std::string& state,
                                                const std::string& quantity);

// All quantities that the states' surfaces have, each once, in their order.
std::vector<Quantity> QuantitiesOf(const Pipe& pipe);

// "state 3, cycle 1, step 2".
std::string StateText(const Pipe& pipe, std::size_t state);
// "axial strain / µε", or the name alone of a plain number.
std::string TitleOf(const Quantity& quantity);

}  // namespace telestrain::viz
