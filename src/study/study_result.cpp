#include "study/study_result.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/numbers.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

Json CellJson(const StudyCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const StudyNumber& number = std::get<StudyNumber>(cell);
  return {{"value", number.value}, {"printed", FormatFixed(number.value, number.decimals)}};
}

Json TableJson(const StudyTable& table) {
  Json columns = Json::array(), rows = Json::array();
  for (const StudyColumn& column : table.columns)
    columns.push_back({{"name", column.name}, {"unit", column.unit}});
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (const StudyCell& cell : row) cells.push_back(CellJson(cell));
    rows.push_back(std::move(cells));
  }
  return {{"id", table.id}, {"title", table.title}, {"columns", columns}, {"rows", rows}};
}

Json SeriesJson(const StudySeries& series) {
  Json json{{"name", series.name},
            {"kind", kSeriesKindNames[static_cast<std::size_t>(series.kind)]},
            {"x", series.x},
            {"y", series.y}};
  if (!series.half_height.empty()) json["half_height"] = series.half_height;
  return json;
}

Json PlotJson(const StudyPlot& plot) {
  Json series = Json::array(), limits = Json::array();
  for (const StudySeries& one : plot.series) series.push_back(SeriesJson(one));
  for (const StudyLimit& limit : plot.limits)
    limits.push_back({{"y", limit.y}, {"text", limit.text}});
  return {{"id", plot.id},
          {"title", plot.title},
          {"caption", plot.caption},
          {"x", {{"label", plot.x.label}, {"log", plot.x.logarithmic}}},
          {"y", {{"label", plot.y.label}, {"log", plot.y.logarithmic}}},
          {"series", series},
          {"limits", limits}};
}

// The text as a number, or null.
Json NumberJson(const std::string& text) {
  const auto number = ParseDouble(text);
  return number ? Json(*number) : Json();
}

Json ComparisonJson(const StudyComparison& line) {
  return {{"quantity", line.quantity}, {"unit", line.unit},
          {"paper", line.paper},       {"paper_value", NumberJson(line.paper)},
          {"ours", line.ours},         {"ours_value", NumberJson(line.ours)},
          {"limit", line.limit},       {"met", line.met ? Json(*line.met) : Json()},
          {"differs", line.differs}};
}

std::string MetText(const std::optional<bool>& met) { return !met ? "" : *met ? "met" : "NOT met"; }

// Characters, not bytes.
std::size_t LengthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string Padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, LengthOf(text)), ' ');
}

}  // namespace

bool StudyResult::AllMet() const {
  return std::all_of(comparison.begin(), comparison.end(),
                     [](const StudyComparison& line) { return line.met.value_or(true); });
}

Json StudyResult::ToJson() const {
  Json json{{"schema", kStudySchema},
            {"study", study},
            {"title", title},
            {"question", question},
            {"answer", answer}};
  for (const char* key : {"comparison", "plots", "tables", "images", "notes", "settings"})
    json[key] = Json::array();
  for (const StudyComparison& line : comparison) json["comparison"].push_back(ComparisonJson(line));
  for (const StudyPlot& plot : plots) json["plots"].push_back(PlotJson(plot));
  for (const StudyTable& table : tables) json["tables"].push_back(TableJson(table));
  for (const StudyImage& image : images)
    json["images"].push_back({{"file", image.file}, {"caption", image.caption}});
  json["notes"] = notes;
  for (const StudySetting& setting : settings)
    json["settings"].push_back(
        {{"name", setting.name}, {"value", setting.value}, {"unit", setting.unit}});
  return json;
}

std::string StudyResult::ComparisonText() const {
  constexpr std::size_t kColumns = 5;
  std::vector<std::array<std::string, kColumns>> rows{{"quantity", "paper", "ours", "limit", ""}};
  for (const StudyComparison& line : comparison)
    rows.push_back({line.quantity + (line.unit.empty() ? "" : " / " + line.unit), line.paper,
                    line.ours, line.limit, MetText(line.met)});
  std::array<std::size_t, kColumns> widths{};
  for (const auto& row : rows)
    for (std::size_t i = 0; i < kColumns; ++i) widths[i] = std::max(widths[i], LengthOf(row[i]));
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < kColumns; ++i) line += Padded(row[i], widths[i] + 2);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace telestrain
