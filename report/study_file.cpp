#include "report/study_file.h"

#include <cmath>
#include <limits>

#include "base/json_file.h"
#include "base/numbers.h"
#include "report/rounding.h"
#include "report/study_report.h"

namespace telestrain {
namespace {

constexpr const char* kMaker = "telestrain study";
constexpr int kDigits = 4;  // of a number of a table

std::string Under(const std::string& pointer, std::size_t index) {
  return pointer + "/" + std::to_string(index);
}

// Reads entries and keeps the first thing that is wrong.
class StudyReader {
 public:
  explicit StudyReader(Json json) { study_.json = std::move(json); }
  void Read();
  const std::string& failure() const { return failure_; }  // empty: all is well
  Study TakeStudy() { return std::move(study_); }

 private:
  void Fail(const std::string& pointer, const std::string& what) {
    if (failure_.empty()) failure_ = pointer + ": " + what;
  }
  const Json& At(const std::string& pointer) const { return EntryAt(study_.json, pointer); }
  std::string Text(const std::string& pointer, bool required = false);
  const Json& List(const std::string& pointer, bool required = false);
  std::optional<double> Number(const std::string& pointer);
  std::vector<double> Numbers(const std::string& pointer);

  void ReadComparison();
  void ReadTable(const std::string& pointer);
  void ReadCell(const std::string& pointer);
  StudyPlot ReadPlot(const std::string& pointer);
  StudyAxis ReadAxis(const std::string& pointer);
  StudySeries ReadSeries(const std::string& pointer);
  void CheckBins(const std::string& pointer, const StudySeries& series);
  void CheckPositive(const std::string& pointer, const StudyPlot& plot);
  void ReadTexts();

  Study study_;
  std::string failure_;
};

std::string StudyReader::Text(const std::string& pointer, bool required) {
  const Json& entry = At(pointer);
  if (entry.is_null() && !required) return "";
  if (entry.is_string()) return entry.get<std::string>();
  Fail(pointer, entry.is_null() ? "is missing, wanted a text" : "must be a text");
  return "";
}

const Json& StudyReader::List(const std::string& pointer, bool required) {
  const Json& entry = At(pointer);
  if (!entry.is_array() && (required || !entry.is_null())) Fail(pointer, "must be a list");
  return ListAt(study_.json, pointer);
}

std::optional<double> StudyReader::Number(const std::string& pointer) {
  const auto value = NumberAt(study_.json, pointer);
  if (!value && !At(pointer).is_null()) Fail(pointer, "must be a finite number");
  return value;
}

std::vector<double> StudyReader::Numbers(const std::string& pointer) {
  std::vector<double> numbers;
  const Json& list = List(pointer, true);
  for (std::size_t i = 0; i < list.size(); ++i)
    numbers.push_back(Number(Under(pointer, i)).value_or(std::numeric_limits<double>::quiet_NaN()));
  return numbers;
}

void StudyReader::ReadComparison() {
  for (std::size_t i = 0; i < List("/comparison").size(); ++i) {
    const std::string pointer = Under("/comparison", i);
    Text(pointer + "/quantity", true);
    for (const char* key : {"/unit", "/paper", "/ours", "/limit", "/differs"}) Text(pointer + key);
    const Json& met = At(pointer + "/met");
    if (!met.is_null() && !met.is_boolean())
      Fail(pointer + "/met", "must be true, false or null (nothing to meet)");
  }
}

void StudyReader::ReadCell(const std::string& pointer) {
  Json& cell = study_.json.at(Json::json_pointer(pointer));
  if (cell.is_object()) {
    if (!Number(pointer + "/value")) Fail(pointer + "/value", "is missing, wanted a number");
    Text(pointer + "/printed", true);
  } else if (cell.is_number()) {
    const double value = cell.get<double>();
    if (!std::isfinite(value)) return Fail(pointer, "must be a finite number");
    const std::string printed =
        cell.is_number_float() ? PrintSignificant(value, kDigits) : cell.dump();
    cell = Json{{"value", value}, {"printed", printed}};
  } else if (!cell.is_string() && !cell.is_null()) {
    Fail(pointer, "must be a number, a text, null or {\"value\", \"printed\"}");
  }
}

void StudyReader::ReadTable(const std::string& pointer) {
  Text(pointer + "/title", true);
  const std::size_t columns = List(pointer + "/columns", true).size();
  if (columns == 0) Fail(pointer + "/columns", "must name a column at least");
  for (std::size_t i = 0; i < columns; ++i) {
    Text(Under(pointer + "/columns", i) + "/name", true);
    Text(Under(pointer + "/columns", i) + "/unit");
  }
  for (std::size_t r = 0; r < List(pointer + "/rows", true).size(); ++r) {
    const std::string row = Under(pointer + "/rows", r);
    const std::size_t cells = List(row, true).size();
    if (cells != columns)
      Fail(row, "has " + std::to_string(cells) + " cells, wanted one for each of the " +
                    std::to_string(columns) + " columns");
    for (std::size_t i = 0; i < cells; ++i) ReadCell(Under(row, i));
  }
}

StudyAxis StudyReader::ReadAxis(const std::string& pointer) {
  StudyAxis axis;
  axis.label = Text(pointer + "/label", true);
  const Json& log = At(pointer + "/log");
  if (!log.is_null() && !log.is_boolean()) Fail(pointer + "/log", "must be true or false");
  axis.logarithmic = log == true;
  axis.low = Number(pointer + "/low");
  axis.high = Number(pointer + "/high");
  for (const auto& [key, end] : {std::pair("/low", axis.low), std::pair("/high", axis.high)})
    if (axis.logarithmic && end && !(*end > 0))
      Fail(pointer + key, "must be positive on a logarithmic axis");
  return axis;
}

StudySeries StudyReader::ReadSeries(const std::string& pointer) {
  StudySeries series;
  series.name = Text(pointer + "/name", true);
  const std::string kind = Text(pointer + "/kind", true);
  bool known = false;
  for (std::size_t k = 0; k < kSeriesKindNames.size(); ++k) {
    if (kind != kSeriesKindNames[k]) continue;
    series.kind = static_cast<SeriesKind>(k);
    known = true;
  }
  if (!known)
    Fail(pointer + "/kind", "there is no kind '" + kind + "'; did you mean '" +
                                NearestWord(kind, kSeriesKindNames) + "'?");
  series.x = Numbers(pointer + "/x");
  series.y = Numbers(pointer + "/y");
  if (!At(pointer + "/half_height").is_null())
    series.half_height = Numbers(pointer + "/half_height");
  if (series.x.size() != series.y.size() ||
      (!series.half_height.empty() && series.half_height.size() != series.x.size()))
    Fail(pointer, "x, y and half_height must have as many values: x has " +
                      std::to_string(series.x.size()) + ", y " + std::to_string(series.y.size()) +
                      ", half_height " + std::to_string(series.half_height.size()));
  if (series.kind == SeriesKind::kBars || series.kind == SeriesKind::kStep)
    CheckBins(pointer, series);
  return series;
}

void StudyReader::CheckBins(const std::string& pointer, const StudySeries& series) {
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (std::isnan(series.x[i]) || (i > 0 && !(series.x[i] > series.x[i - 1])))
      Fail(Under(pointer + "/x", i), "the middles of bars and steps must grow");
}

void StudyReader::CheckPositive(const std::string& pointer, const StudyPlot& plot) {
  const auto check = [&](const std::string& list, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] <= 0)
        Fail(Under(list, i), "is " + FormatShortest(values[i]) +
                                 ", a logarithmic axis wants positive numbers; use null to leave "
                                 "it out");
  };
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const std::string at = Under(pointer + "/series", s);
    if (plot.x.logarithmic) check(at + "/x", plot.series[s].x);
    if (plot.y.logarithmic) check(at + "/y", plot.series[s].y);
  }
  for (std::size_t i = 0; i < plot.limits.size(); ++i)
    if (plot.y.logarithmic && plot.limits[i].y <= 0)
      Fail(Under(pointer + "/limits", i) + "/y", "must be positive on a logarithmic axis");
}

StudyPlot StudyReader::ReadPlot(const std::string& pointer) {
  StudyPlot plot;
  plot.title = Text(pointer + "/title", true);
  plot.caption = Text(pointer + "/caption");
  plot.x = ReadAxis(pointer + "/x");
  plot.y = ReadAxis(pointer + "/y");
  for (std::size_t i = 0; i < List(pointer + "/series", true).size(); ++i)
    plot.series.push_back(ReadSeries(Under(pointer + "/series", i)));
  for (std::size_t i = 0; i < List(pointer + "/limits").size(); ++i) {
    const std::string at = Under(pointer + "/limits", i);
    const auto y = Number(at + "/y");
    if (!y) Fail(at + "/y", "is missing, wanted a number");
    plot.limits.push_back({y.value_or(1), Text(at + "/text", true)});
  }
  CheckPositive(pointer, plot);
  return plot;
}

void StudyReader::ReadTexts() {
  for (const char* key : {"/study", "/title"}) Text(key, true);
  for (const char* key : {"/question", "/answer"}) Text(key);
  for (std::size_t i = 0; i < List("/images").size(); ++i) {
    Text(Under("/images", i) + "/file", true);
    Text(Under("/images", i) + "/caption");
  }
  for (std::size_t i = 0; i < List("/notes").size(); ++i) Text(Under("/notes", i), true);
  for (std::size_t i = 0; i < List("/settings").size(); ++i) {
    const std::string pointer = Under("/settings", i);
    Text(pointer + "/name", true);
    Text(pointer + "/unit");
    if (!At(pointer + "/value").is_primitive() || At(pointer + "/value").is_null())
      Fail(pointer + "/value", "must be a text, a number, true or false");
  }
}

void StudyReader::Read() {
  ReadTexts();
  ReadComparison();
  for (std::size_t i = 0; i < List("/plots").size(); ++i)
    study_.plots.push_back(ReadPlot(Under("/plots", i)));
  for (std::size_t i = 0; i < List("/tables").size(); ++i) ReadTable(Under("/tables", i));
}

}  // namespace

Result<Study> ReadStudy(const std::filesystem::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(Json json, ReadJson(path, kStudySchema, kMaker));
  StudyReader reader(std::move(json));
  reader.Read();
  if (!reader.failure().empty())
    return BadInput(path.string() + ": " + reader.failure() + "; make the file again with '" +
                    kMaker + "'");
  return reader.TakeStudy();
}

}  // namespace telestrain
