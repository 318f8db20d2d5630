#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json_file.h"
#include "viz/scene/json_node.h"
#include "viz/scene_from_results.h"
#include "viz/surface_file.h"

namespace telestrain::viz {
namespace {

// Index of the state with the largest absolute long-base strain; the first of equals.
int LargestState(const JsonNode& states) {
  int largest = 0;
  double largest_microstrain = -1;
  for (int i = 0; i < states.Size(); ++i) {
    const double microstrain = std::abs(states.At(i).At("axial_microstrain").Number());
    if (microstrain > largest_microstrain) {
      largest_microstrain = microstrain;
      largest = i;
    }
  }
  return largest;
}

double NumberOrZero(const JsonNode& node, const std::string& key) {
  return node.Has(key) ? node.At(key).Number() : 0;
}

Pipe ReadPipe(const JsonNode& strain, std::string* surface_file) {
  Pipe pipe;
  const JsonNode fit = strain.At("pipe");
  pipe.axis_point_in_array_mm = fit.At("axis_point_in_array_mm").Vector3();
  pipe.axis_in_array = fit.At("axis_in_array").Direction();
  pipe.radius_mm = fit.At("radius_mm").Positive();
  pipe.base_length_mm = strain.At("base_length_mm").Positive();
  const JsonNode states = strain.At("states");
  const JsonNode state = states.At(LargestState(states));
  PipeState largest;
  largest.cycle = state.At("cycle").Text();
  largest.step = state.At("step").Text();
  largest.axial_microstrain = state.At("axial_microstrain").Number();
  largest.standard_uncertainty_microstrain =
      NumberOrZero(state, "standard_uncertainty_microstrain");
  largest.local_microstrain = {NumberOrZero(state, "local_a_microstrain"),
                               NumberOrZero(state, "local_b_microstrain")};
  pipe.states.push_back(largest);
  *surface_file = state.At("file").Text();
  return pipe;
}

}  // namespace

Result<std::optional<Pipe>> PipeFromResults(const std::filesystem::path& results) {
  const auto path = results / "strain.json";
  if (!std::filesystem::exists(path)) return std::optional<Pipe>{};
  TELESTRAIN_ASSIGN_OR_RETURN(const auto strain,
                              ReadJson(path, "telestrain.strain/1", "telestrain measure"));
  Pipe pipe;
  std::string surface_file;
  try {
    pipe = ReadPipe(JsonNode(strain), &surface_file);
  } catch (const BadField& bad) {
    return BadInput(path.string() + ": " + bad.what() +
                    "; make the file again with 'telestrain measure'");
  }
  TELESTRAIN_ASSIGN_OR_RETURN(
      pipe.states.front().surface,
      ReadSurface(results / std::filesystem::path(surface_file).filename()));
  return std::optional<Pipe>(std::move(pipe));
}

}  // namespace telestrain::viz
