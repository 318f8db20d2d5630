#include <cctype>
#include <map>

#include "report/results_parts.h"

namespace telestrain {
namespace {

void AddArtefacts(const Json& inputs, ResultsDraft& draft) {
  ResultTable table = FactTable("artefacts", "Instrument and artefacts");
  const auto number = [&](const char* name, const char* pointer, const char* unit) {
    if (const auto value = NumberAt(inputs, pointer)) table.AddFact(name, ExactCell(value), unit);
  };
  const auto count = [&](const char* name, const char* pointer, const char* unit) {
    if (const auto value = NumberAt(inputs, pointer)) table.AddFact(name, CountCell(value), unit);
  };
  // Zero in inputs.json means that the session does not say it.
  const auto given = [&](const char* name, const char* pointer, const char* unit) {
    if (NumberAt(inputs, pointer).value_or(0) > 0) number(name, pointer, unit);
  };
  count("Sensor width", "/sensor/width_px", "px");
  count("Sensor height", "/sensor/height_px", "px");
  number("Pixel pitch", "/sensor/pixel_pitch_um", "µm");
  number("Nominal magnification", "/lens/magnification", "");
  number("Depth of field", "/lens/depth_of_field_mm", "mm");
  count("Board corners along x", "/target/columns", "");
  count("Board corners along y", "/target/rows", "");
  number("Board square", "/target/square_mm", "mm");
  given("Corner position on the board, standard uncertainty", "/target/sigma_square_um", "µm");
  given("Board separation, standard uncertainty", "/target/sigma_separation_um", "µm");
  given("Board coplanarity, half-width", "/target/coplanarity_um", "µm");
  given("Ruler length", "/ruler/length_mm", "mm");
  given("Ruler length, standard uncertainty", "/ruler/sigma_length_um", "µm");
  given("Pipe outer diameter, nominal", "/pipe/outer_diameter_mm", "mm");
  given("Pipe Poisson ratio", "/pipe/poisson_ratio", "");
  if (const std::string material = TextAt(inputs, "/pipe/material"); !material.empty())
    table.AddFact("Pipe material", material);
  count("Calibration images", "/counts/calibration_images", "");
  count("Ruler images", "/counts/ruler_images", "");
  count("Pipe images", "/counts/pipe_images", "");
  draft.AddTable(std::move(table));
}

void AddSoftware(const Json& inputs, ResultsDraft& draft) {
  ResultTable table("software", "Software", {{"Component", ""}, {"Version", ""}});
  table.AddRow({TextAt(inputs, "/program/name", "telestrain"),
                TextAt(inputs, "/program/version", kNoValue)});
  const Json& libraries = EntryAt(inputs, "/program/libraries");
  if (libraries.is_object())
    for (const auto& [name, version] : libraries.items())
      table.AddRow({name, version.is_string() ? version : Json(version.dump())});
  draft.AddTable(std::move(table));
}

// Pipe images that were measured as they arrived may be other files than the session's.
std::map<std::string, std::string> MeasuredHashes(const Json& strain) {
  std::map<std::string, std::string> hashes;
  for (const Json& state : ListAt(strain, "/states"))
    if (EntryAt(state, "/image_sha256").is_string())
      hashes[TextAt(state, "/image")] = TextAt(state, "/image_sha256");
  return hashes;
}

void AddFiles(const Json& inputs, const Json& strain, ResultsDraft& draft) {
  ResultTable table("input-files", "Input files",
                    {{"File", ""}, {"Size", "bytes"}, {"SHA-256", ""}});
  auto measured = MeasuredHashes(strain);
  for (const Json& file : ListAt(inputs, "/files")) {
    const std::string path = TextAt(file, "/path", kNoValue);
    const auto found = measured.find(path);
    const bool other = found != measured.end() && found->second != TextAt(file, "/sha256");
    if (!other) {
      table.AddRow({path, CountCell(NumberAt(file, "/bytes")), TextAt(file, "/sha256", kNoValue)});
      if (found != measured.end()) measured.erase(found);
    }
  }
  for (const auto& [path, sha256] : measured)
    table.AddRow({Phrase("{{path}} (watched)", {{"path", path}}), kNoValue, sha256});
  draft.AddTable(std::move(table));
}

}  // namespace

std::string KeyAsLabel(std::string key) {
  for (char& c : key)
    if (c == '_') c = ' ';
  if (!key.empty()) key[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
  return key;
}

void AddInputs(const Json& inputs, const Json& strain, ResultsDraft& draft) {
  AddArtefacts(inputs, draft);
  AddSoftware(inputs, draft);
  AddFiles(inputs, strain, draft);
}

Acceptance ReadAcceptance(const Json& inputs) {
  Acceptance acceptance;
  acceptance.reprojection_rms_px = NumberAt(inputs, "/acceptance/reprojection_rms_px");
  acceptance.ruler_mpe_um = NumberAt(inputs, "/acceptance/ruler_mpe_um");
  acceptance.strain_error_microstrain = NumberAt(inputs, "/acceptance/strain_error_microstrain");
  acceptance.coverage_factor = NumberAt(inputs, "/acceptance/coverage_factor").value_or(2);
  const bool simple = TextAt(inputs, "/acceptance/decision_rule") == "simple";
  acceptance.rule = simple ? DecisionRule::kSimple : DecisionRule::kGuarded;
  return acceptance;
}

}  // namespace telestrain
