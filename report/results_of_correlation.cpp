#include <algorithm>
#include <array>
#include <cmath>

#include "base/numbers.h"
#include "report/results_parts.h"

namespace telestrain {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;
constexpr const char* kNotMeasured = "not measured";
constexpr const char* kNotStated = "not stated";

// The angle between the viewing directions of the first two views of `group`.
std::optional<double> StereoAngle_deg(const Json& calibration, const std::string& group) {
  std::vector<std::array<double, 3>> axes;
  for (const Json& view : ListAt(calibration, "/views")) {
    if (TextAt(view, "/group") != group) continue;
    const auto x = NumberAt(view, "/axis_in_array/0"), y = NumberAt(view, "/axis_in_array/1"),
               z = NumberAt(view, "/axis_in_array/2");
    if (x && y && z) axes.push_back({*x, *y, *z});
  }
  if (axes.size() < 2) return {};
  double dot = 0;
  for (int i = 0; i < 3; ++i) dot += axes[0][i] * axes[1][i];
  return kDegreesPerRadian * std::acos(std::clamp(dot, -1.0, 1.0));
}

void AddStereoAngles(const Json& calibration, ResultTable& table) {
  std::vector<std::string> groups;
  for (const Json& view : ListAt(calibration, "/views")) {
    const std::string group = TextAt(view, "/group");
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  for (const std::string& group : groups)
    if (const auto angle = StereoAngle_deg(calibration, group))
      table.AddFact(Phrase("Stereo angle, group {{group}}", {{"group", group}}),
                    FixedCell(angle, 2), "°");
}

// A row of a value that may be missing.
void AddMeasured(const char* name, Json cell, const char* unit, ResultTable& table) {
  if (EntryAt(cell, "/value").is_null())
    table.AddFact(name, kNotMeasured);
  else
    table.AddFact(name, std::move(cell), unit);
}

void AddImageScale(const Json& calibration, const Acceptance& acceptance, ResultTable& table) {
  const auto scale = NumberAt(calibration, "/lens/magnification_px_per_mm");
  const auto expanded =
      acceptance.Expanded(NumberAt(calibration, "/lens/sigma_magnification_px_per_mm"));
  AddMeasured(
      "Image scale",
      UncertainCell(scale.value_or(0), scale ? expanded : std::nullopt, SignificantCell(scale, 6)),
      "px/mm", table);
}

// The same in both tables of the correlation.
void AddSettings(const Json& strain, ResultTable& table) {
  const auto number = [&](const char* pointer) { return ExactCell(NumberAt(strain, pointer)); };
  table.AddFact("Subset", number("/options/subset_px"), "px");
  table.AddFact("Step of the grid", number("/options/step_px"), "px");
  table.AddFact("Shape function", TextAt(strain, "/options/shape_function", kNoValue));
  table.AddFact("Interpolant", TextAt(strain, "/options/interpolant", kNoValue));
  table.AddFact("Criterion", TextAt(strain, "/options/criterion", kNoValue));
  table.AddFact("Prefilter, Gaussian sigma", number("/options/prefilter_sigma_px"), "px");
  table.AddFact("Virtual strain gauge",
                FixedCell(NumberAt(strain, "/options/virtual_strain_gauge_mm"), 2), "mm");
}

void AddSettingsTable(const Json& strain, const Json& calibration, ResultsDraft& draft) {
  ResultTable table = FactTable("correlation", "Correlation settings");
  AddSettings(strain, table);
  if (!calibration.is_null()) {
    AddImageScale(calibration, draft.acceptance, table);
    AddStereoAngles(calibration, table);
  }
  draft.AddTable(std::move(table));
}

// The object side of every view's region; one row for all views of one size.
void AddFields(const Json& calibration, ResultTable& table) {
  const auto scale = NumberAt(calibration, "/lens/magnification_px_per_mm");
  std::vector<std::pair<std::string, std::string>> sizes;  // printed size, views
  for (const Json& view : ListAt(calibration, "/views")) {
    const auto width_px = NumberAt(view, "/region_px/2"),
               height_px = NumberAt(view, "/region_px/3");
    if (!scale || !width_px || !height_px) continue;
    const std::string size =
        FormatFixed(*width_px / *scale, 2) + " × " + FormatFixed(*height_px / *scale, 2);
    const std::string name = TextAt(view, "/name", "?");
    const auto same = std::find_if(sizes.begin(), sizes.end(),
                                   [&](const auto& known) { return known.first == size; });
    if (same == sizes.end())
      sizes.emplace_back(size, name);
    else
      same->second += ", " + name;
  }
  for (const auto& [size, views] : sizes)
    table.AddFact(Phrase("Field of view of {{views}}", {{"views", views}}), size, "mm");
  if (sizes.empty()) table.AddFact("Field of view", kNotMeasured);
}

void AddCamera(const Json& inputs, const Json& calibration, const Acceptance& acceptance,
               ResultTable& table) {
  const auto width_px = NumberAt(inputs, "/sensor/width_px"),
             height_px = NumberAt(inputs, "/sensor/height_px");
  if (width_px && height_px)
    table.AddFact("Sensor", FormatFixed(*width_px, 0) + " × " + FormatFixed(*height_px, 0), "px");
  table.AddFact("Pixel pitch", ExactCell(NumberAt(inputs, "/sensor/pixel_pitch_um")), "µm");
  table.AddFact("Lens", "telecentric");
  table.AddFact("Nominal magnification", ExactCell(NumberAt(inputs, "/lens/magnification")));
  AddImageScale(calibration, acceptance, table);
  AddStereoAngles(calibration, table);
  AddFields(calibration, table);
  table.AddFact("Depth of field, nominal", ExactCell(NumberAt(inputs, "/lens/depth_of_field_mm")),
                "mm");
}

// The standard deviation of states without strain: at rest if there were such states, else moved.
void AddFloorFact(const Json& strain, ResultTable& table) {
  const auto still = NumberAt(strain, "/sequence/noise_floor_still/sd_microstrain"),
             moved = NumberAt(strain, "/sequence/noise_floor_moved/sd_microstrain");
  AddMeasured(still || !moved ? "Strain noise floor, standard deviation at rest"
                              : "Strain noise floor, standard deviation between moved states",
              UncertaintyCell(still ? still : moved), "µε", table);
}

// The reporting table of the iDICs good practices guide. What nobody measured says so.
void AddReportingTable(const Json& inputs, const Json& calibration, const Json& strain,
                       ResultsDraft& draft) {
  ResultTable table =
      FactTable("idics", "Correlation, reported after the iDICs good practices guide");
  AddCamera(inputs, calibration, draft.acceptance, table);
  table.AddFact("Pattern, how it was made", TextAt(inputs, "/document/pattern", kNotStated));
  table.AddFact("Pattern, size of a feature", kNotMeasured);
  AddSettings(strain, table);
  table.AddFact("Strain", TextAt(strain, "/definitions/strain", kNotStated));
  table.AddFact("Surface points", CountCell(NumberAt(strain, "/pipe/points")));
  AddMeasured("Base length of the axial strain", FixedCell(NumberAt(strain, "/base_length_mm"), 4),
              "mm", table);
  AddFloorFact(strain, table);
  draft.AddTable(std::move(table));
}

// One row of states without strain; null: there were none.
void AddFloor(const Json& floor, const char* name, ResultTable& table) {
  const ResultCellPair mean =
      ResultCells(NumberAt(floor, "/mean_microstrain/value"),
                  NumberAt(floor, "/mean_microstrain/expanded_uncertainty"), 2);
  const auto alone = [&](const char* pointer) { return UncertaintyCell(NumberAt(floor, pointer)); };
  table.AddRow({name, floor.is_object() ? CountCell(NumberAt(floor, "/count")) : kNotMeasured,
                mean.value, mean.uncertainty, alone("/sd_microstrain"),
                alone("/stated_sd_microstrain"), alone("/max_abs_microstrain"),
                FixedCell(NumberAt(floor, "/largest_motion_mm"), 3)});
}

void AddNoiseFloors(const Json& sequence, ResultsDraft& draft) {
  ResultTable table("noise-floor",
                    "Zero-strain noise floor and pseudo-strain of rigid motions (VDI/VDE 2626)",
                    {{"Pipe without strain", ""},
                     {"States", ""},
                     {"Mean", "µε"},
                     {"U", "µε"},
                     {"Standard deviation", "µε"},
                     {"Stated for one reading", "µε"},
                     {"Largest |strain|", "µε"},
                     {"Largest motion", "mm"}});
  AddFloor(EntryAt(sequence, "/noise_floor_still"), "at rest: noise floor", table);
  AddFloor(EntryAt(sequence, "/noise_floor_moved"), "rigidly moved: pseudo-strain", table);
  draft.AddTable(std::move(table));
}

}  // namespace

void AddCorrelation(const Json& inputs, const Json& calibration, const Json& strain,
                    ResultsDraft& draft) {
  if (ListAt(strain, "/states").empty()) return;
  AddSettingsTable(strain, calibration, draft);
  AddReportingTable(inputs, calibration, strain, draft);
  AddNoiseFloors(EntryAt(strain, "/sequence"), draft);
}

}  // namespace telestrain
