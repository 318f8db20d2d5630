#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json_file.h"
#include "viz/results_parts.h"
#include "viz/surface_file.h"

namespace telestrain::viz {
namespace {

// What the gauge of a column read; nothing where it has no value.
std::optional<double> ReadingOf(const JsonNode& readings, const std::string& column) {
  for (int i = 0; i < readings.Size(); ++i) {
    const JsonNode reading = readings.At(i);
    if (reading.At("column").Text() != column) continue;
    if (!reading.Has("microstrain")) return {};
    return reading.At("microstrain").Number();
  }
  return {};
}

PipeState StateOf(const JsonNode& node, const std::vector<PipeGauge>& gauges) {
  PipeState state;
  state.image = node.At("image").Text();
  state.cycle = node.At("cycle").Text();
  state.step = node.At("step").Text();
  state.axial_microstrain = node.At("axial_microstrain").Number();
  state.standard_uncertainty_microstrain = node.NumberOr("standard_uncertainty_microstrain", 0);
  if (node.Has("gauge_mean_microstrain"))
    state.gauge_mean_microstrain = node.At("gauge_mean_microstrain").Number();
  state.gauge_microstrain.resize(gauges.size());
  if (!node.Has("gauge_readings")) return state;  // measured by a version that did not write them
  for (std::size_t i = 0; i < gauges.size(); ++i)
    state.gauge_microstrain[i] = ReadingOf(node.At("gauge_readings"), gauges[i].column);
  return state;
}

// Index of the state with the largest absolute long-base strain; the first of equals.
std::size_t LargestOf(const std::vector<PipeState>& states) {
  std::size_t largest = 0;
  for (std::size_t i = 1; i < states.size(); ++i)
    if (std::abs(states[i].axial_microstrain) > std::abs(states[largest].axial_microstrain))
      largest = i;
  return largest;
}

// All but the surfaces, whose files are named in the order of the states.
Pipe PipeOf(const JsonNode& strain, const RecordedInputs& inputs,
            std::vector<std::string>* surface_files) {
  Pipe pipe;
  const JsonNode fit = strain.At("pipe");
  pipe.axis_point_in_array_mm = fit.At("axis_point_in_array_mm").Vector3();
  pipe.axis_in_array = fit.At("axis_in_array").Direction();
  pipe.radius_mm = fit.At("radius_mm").Positive();
  pipe.nominal_radius_mm = inputs.nominal_radius_mm;
  if (strain.Has("geometry"))
    pipe.stated_diameter_mm = strain.At("geometry").NumberOr("diameter_mm", 0);
  pipe.base_length_mm = strain.At("base_length_mm").Positive();
  pipe.gauges = PlaceGauges(strain, inputs.gauges, pipe);
  const JsonNode states = strain.At("states");
  if (states.Size() == 0) states.Fail("at least one state is wanted");
  for (int i = 0; i < states.Size(); ++i) {
    pipe.states.push_back(StateOf(states.At(i), inputs.gauges));
    surface_files->push_back(states.At(i).At("file").Text());
  }
  pipe.largest_state = LargestOf(pipe.states);
  return pipe;
}

}  // namespace

Result<std::optional<Pipe>> PipeFromResults(const std::filesystem::path& results,
                                            const RecordedInputs& inputs, int group_count) {
  constexpr const char* kMeasure = "telestrain measure";
  const auto path = results / "strain.json";
  if (!std::filesystem::exists(path)) return std::optional<Pipe>{};
  TELESTRAIN_ASSIGN_OR_RETURN(const auto strain, ReadJson(path, "telestrain.strain/1", kMeasure));
  Pipe pipe;
  std::vector<std::string> files;
  TELESTRAIN_RETURN_IF_ERROR(
      ReadFields(path, kMeasure, [&] { pipe = PipeOf(JsonNode(strain), inputs, &files); }));
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto file = results / std::filesystem::path(files[i]).filename();
    TELESTRAIN_ASSIGN_OR_RETURN(pipe.states[i].surface, ReadSurface(file, group_count));
  }
  return std::optional<Pipe>(std::move(pipe));
}

}  // namespace telestrain::viz
