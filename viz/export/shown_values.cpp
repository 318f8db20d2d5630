#include "viz/export/shown_values.h"

#include <algorithm>

#include "base/numbers.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

Error NoPipe() {
  return BadInput(
      "the results hold no measured pipe, so there is no state and no quantity to choose; run "
      "'telestrain measure' first");
}

Result<std::size_t> StateFor(const Pipe& pipe, const std::string& word) {
  if (word == "largest") return pipe.largest_state;
  for (std::size_t i = 0; i < pipe.states.size(); ++i)
    if (word == std::to_string(i) || word == pipe.states[i].image) return i;
  return Error{ErrorKind::kUsage, "--state " + word + ": the results have the states 0 to " +
                                      std::to_string(pipe.states.size() - 1) +
                                      ", their images and 'largest'"};
}

Error NoSuchQuantity(const std::string& key, const std::vector<Quantity>& quantities) {
  std::vector<std::string> keys;
  std::string list;
  for (const Quantity& quantity : quantities) {
    keys.push_back(quantity.key);
    list += (list.empty() ? "" : " ") + quantity.key;
  }
  return {ErrorKind::kUsage, "--quantity " + key + ": the nearest quantity is '" +
                                 NearestWord(key, keys) + "'; the surface has " + list};
}

}  // namespace

std::vector<Quantity> QuantitiesOf(const Pipe& pipe) {
  std::vector<Quantity> quantities;
  for (const PipeState& state : pipe.states)
    for (const PointValues& values : state.surface.values)
      if (std::none_of(quantities.begin(), quantities.end(),
                       [&](const Quantity& q) { return q.key == values.quantity.key; }))
        quantities.push_back(values.quantity);
  return quantities;
}

Result<std::optional<ShownValues>> ChooseValues(const Scene& scene, const std::string& state,
                                                const std::string& quantity) {
  if (!scene.pipe || scene.pipe->states.empty()) {
    if (state != "largest" || !quantity.empty()) return NoPipe();
    return std::optional<ShownValues>{};
  }
  const Pipe& pipe = *scene.pipe;
  TELESTRAIN_ASSIGN_OR_RETURN(const std::size_t number, StateFor(pipe, state));
  const auto quantities = QuantitiesOf(pipe);
  const auto found = std::find_if(quantities.begin(), quantities.end(), [&](const Quantity& q) {
    return quantity.empty() || q.key == quantity;
  });
  if (found == quantities.end()) return NoSuchQuantity(quantity, quantities);
  return std::optional<ShownValues>({number, *found, ValueScale(pipe, found->key)});
}

std::string StateText(const Pipe& pipe, std::size_t state) {
  const PipeState& shown = pipe.states[state];
  return "state " + std::to_string(state) + ", cycle " + shown.cycle + ", step " + shown.step;
}

std::string TitleOf(const Quantity& quantity) {
  return quantity.unit.empty() ? quantity.name : quantity.name + " / " + quantity.unit;
}

}  // namespace telestrain::viz
