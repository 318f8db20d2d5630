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

Error NoSuchState(int state, std::size_t states) {
  return {ErrorKind::kUsage, "--state " + std::to_string(state) +
                                 ": the results have the states 0 to " +
                                 std::to_string(states - 1)};
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

Result<std::optional<ShownValues>> ChooseValues(const Scene& scene, std::optional<int> state,
                                                const std::string& quantity) {
  if (!scene.pipe || scene.pipe->states.empty()) {
    if (state || !quantity.empty()) return NoPipe();
    return std::optional<ShownValues>{};
  }
  const Pipe& pipe = *scene.pipe;
  const auto quantities = QuantitiesOf(pipe);
  if (quantities.empty()) return NoPipe();
  const int number = state.value_or(static_cast<int>(pipe.largest_state));
  if (number < 0 || number >= static_cast<int>(pipe.states.size()))
    return NoSuchState(number, pipe.states.size());
  const auto found = quantity.empty()
                         ? quantities.begin()
                         : std::find_if(quantities.begin(), quantities.end(),
                                        [&](const Quantity& q) { return q.key == quantity; });
  if (found == quantities.end()) return NoSuchQuantity(quantity, quantities);
  return std::optional<ShownValues>(
      {static_cast<std::size_t>(number), *found, ValueScale(pipe, found->key)});
}

std::string StateText(const Pipe& pipe, std::size_t state) {
  const PipeState& shown = pipe.states[state];
  return "state " + std::to_string(state) + ", cycle " + shown.cycle + ", step " + shown.step;
}

std::string TitleOf(const Quantity& quantity) {
  return quantity.unit.empty() ? quantity.name : quantity.name + " / " + quantity.unit;
}

}  // namespace telestrain::viz
