#include <chrono>
#include <cmath>

#include "base/check.h"
#include "base/numbers.h"
#include "report/dcc/dcc_parts.h"
#include "report/dcc/dsi_number.h"
#include "report/result_cells.h"

namespace telestrain {
namespace {

// The day of an ISO 8601 text, or nothing.
std::string Day(const std::string& text) {
  const std::string day = text.substr(0, 10);
  if (day.size() != 10 || day[4] != '-' || day[7] != '-') return "";
  const auto year = ParseInt(day.substr(0, 4)), month = ParseInt(day.substr(5, 2)),
             number = ParseInt(day.substr(8, 2));
  if (!year || !month || !number || *year < 1 || *month < 1 || *number < 1) return "";
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*number))};
  return date.ok() ? day : "";
}

}  // namespace

std::string PrintedOf(const Json& cell) {
  if (cell.is_string()) return cell.get<std::string>();
  if (!cell.is_array()) return TextAt(cell, "/printed");
  std::string paragraph;
  for (const Json& sentence : cell) paragraph += PrintedOf(sentence) + " ";
  return XmlText(paragraph);
}

std::string PrintedAt(const Json& json, const std::string& pointer) {
  return PrintedOf(EntryAt(json, pointer));
}

std::string DocumentFact(const Json& results, std::initializer_list<const char*> keys) {
  const Json& document = EntryAt(results, "/document");
  for (const char* key : keys) {
    if (!document.is_object() || !document.contains(key)) continue;
    const Json& value = document[key];
    const std::string text = XmlText(value.is_string() ? value.get<std::string>() : value.dump());
    if (!text.empty()) return text;
  }
  return "";
}

std::string DocumentFactOr(const Json& results, std::initializer_list<const char*> keys) {
  const std::string fact = DocumentFact(results, keys);
  return fact.empty() ? kNotStated : fact;
}

std::string DocumentDay(const Json& results, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (const std::string day = Day(DocumentFact(results, {key})); !day.empty()) return day;
  return "";
}

std::pair<std::string, std::string> PerformanceDates(const Json& results) {
  std::string begin =
      DocumentDay(results, {"measured_from", "begin_date", "measured", "test_date", "date"});
  std::string end = DocumentDay(results, {"measured_to", "end_date"});
  if (end.empty()) end = begin;
  return {begin, end};
}

const Json& TableOf(const Json& results, const std::string& id) {
  return FindBy(ListAt(results, "/tables"), "id", id);
}

bool IsMeasured(const Json& results, const std::string& section) {
  return EntryAt(results, "/measured/" + section) == true;
}

std::string ConformityOf(const std::string& verdict, std::optional<double> value,
                         std::optional<double> limit) {
  if (verdict == "pass" || verdict == "fail") return verdict;
  if (verdict != "doubt" || !value || !limit) return "";
  return std::abs(*value) <= *limit ? "conditionalPass" : "conditionalFail";
}

double CoverageFactorOf(const Json& results) {
  return NumberAt(results, "/decision/coverage_factor").value_or(2);
}

bool IsDccNumber(const DccNumber& number) {
  return DsiUnitOf(number.unit) && DsiNumber(number.value, 0);
}

bool HasDsiCoverage(double coverage_factor) { return coverage_factor >= 1; }

void WriteSmallCoverage(DccXml& xml, const DccNumber& number, double coverage_factor) {
  if (HasDsiCoverage(coverage_factor) || !DsiNumber(number.uncertainty, 0)) return;
  xml.Text("dcc:description", "U = " + number.uncertainty + " " + number.unit +
                                  " (k = " + FormatShortest(coverage_factor) + ")");
}

void WriteReal(DccXml& xml, const DccNumber& number, double coverage_factor) {
  TELESTRAIN_CHECK(IsDccNumber(number), "a number in a unit of the D-SI");
  const DsiUnit unit = *DsiUnitOf(number.unit);
  const auto real = xml.Open("si:real");
  xml.Leaf("si:value", *DsiNumber(number.value, unit.power_of_ten));
  xml.Leaf("si:unit", unit.unit);
  const auto uncertainty = DsiNumber(number.uncertainty, unit.power_of_ten);
  if (!uncertainty || !HasDsiCoverage(coverage_factor)) return;
  const auto outer = xml.Open("si:measurementUncertaintyUnivariate");
  const auto inner = xml.Open("si:expandedMU");
  xml.Leaf("si:valueExpandedMU", *uncertainty);
  xml.Leaf("si:coverageFactor", FormatShortest(coverage_factor));
  xml.Leaf("si:coverageProbability", CoverageProbability(coverage_factor));
  xml.Leaf("si:distribution", "normal");
}

void WriteNonSi(DccXml& xml, const std::string& printed_unit) {
  const auto unit = DsiUnitOf(printed_unit);
  if (!unit || unit->non_si.empty()) return;
  xml.Leaf("dcc:nonSIDefinition",
           "px: the distance of neighbouring pixels of the sensor, counted as one");
  xml.Leaf("dcc:nonSIUnit", unit->non_si);
}

}  // namespace telestrain
