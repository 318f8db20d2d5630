// Small parsers of text; the first character of an input chooses.
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "app/list_arguments.h"
#include "base/csv.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "base/utf8.h"
#include "report/dcc/dsi_number.h"
#include "report/rounding.h"
#include "report/signature/utc_time.h"
#include "report/text_filling.h"
#include "report/unicode_text.h"
#include "robustness/fuzz/fuzz_target.h"
#include "session/toml_tree.h"

namespace telestrain::fuzz {
namespace {

// Row by row without the places in the file.
std::string TableText(const CsvTable& table) {
  std::string text = CsvLine(table.columns);
  for (const CsvTable::Row& row : table.rows) text += CsvLine(row.cells);
  return text;
}

void TryTable(const std::string& text) {
  const auto table = ParseCsv("t.csv", text);
  if (!Succeeds(table)) return;
  for (const CsvTable::Row& row : table->rows)
    Require(row.cells.size() == table->columns.size(), "every row has the header's cells");
  const auto again = ParseCsv("t.csv", TableText(*table));
  Require(again.ok(), "a written table reads: " + (again ? "" : again.error().message));
  Require(again->columns == table->columns && again->rows.size() == table->rows.size(),
          "a written table has the same columns and rows");
  for (std::size_t i = 0; i < table->rows.size(); ++i)
    Require(again->rows[i].cells == table->rows[i].cells, "a written cell reads back equal");
}

void TryNumber(const std::string& text) {
  static_cast<void>(ParseInt(text));
  const auto number = ParseDouble(text);
  if (number) {
    Require(std::isfinite(*number), "a number is finite");
    Require(ParseDouble(FormatShortest(*number)) == number, "the shortest text reads back equal");
    for (const int decimals : {0, 3, 20}) {
      const std::string fixed = FormatFixed(*number, decimals);
      Require(ParseDouble(fixed).has_value(), "fixed notation reads: " + fixed);
    }
  }
  Succeeds(CulledRegion(text));
  Succeeds(DocumentEntry(text));
  if (const auto numbers = WholeNumbersIn(text)) Succeeds(RegionInside(text, *numbers, 100, 80));
  static_cast<void>(DsiUnitOf(text));
  const auto scaled = DsiNumber(text, -6);
  if (number && scaled && std::abs(*number) > 1e-200 && std::abs(*number) < 1e200)
    Require(std::abs(ParseDouble(*scaled).value_or(0) * 1e6 / *number - 1) < 1e-12,
            "a D-SI number keeps its value: " + *scaled);
}

void TryUnicode(const std::string& text) {
  const std::string printable = PrintableText(text);
  Require(IsValidUtf8(printable), "printable text is UTF-8");
  Require(PrintableText(printable) == printable, "printable text needs no escapes");
  for (const char c : printable)
    Require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F, "nothing printable is a control");
  std::string again;
  for (const char32_t code_point : CodePoints(text)) {
    again += Utf8(code_point);
    static_cast<void>(CodePointName(code_point) + (BreaksAnywhere(code_point) ? "" : " "));
  }
  Require(IsValidUtf8(again), "code points make UTF-8");
  Require((again == text) == IsValidUtf8(text), "only well-formed text has its code points");
}

int CountNodes(const TomlNode& node) {
  Require(!node.Shown().empty() && !node.place.empty(), "a value of TOML can be shown");
  int count = 1;
  for (const TomlNode& child : node.children) count += CountNodes(child);
  return count;
}

void TryToml(const std::string& text) {
  const auto root = ParseToml("a.toml", text);
  if (Succeeds(root)) CountNodes(*root);
}

int DepthOf(const nlohmann::json& json) {
  int deepest = 0;
  for (const auto& child : json)
    if (child.is_structured()) deepest = std::max(deepest, DepthOf(child));
  return json.is_structured() ? deepest + 1 : 0;
}

void TryJsonDepth(const std::string& text) {
  constexpr int kDeepest = 12;
  const bool is_deeper = !CheckJsonText(text, kDeepest).ok();
  Succeeds(ParseJson(text));
  if (!CheckJsonText(text).ok()) return;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) return;
  Require(is_deeper == (DepthOf(json) > kDeepest), "the depth of JSON is counted right");
}

void TryTime(const std::string& text) {
  if (const auto time_s = ParsePdfTime(text))
    Require(PdfTime(*time_s) == text, "a PDF's time is written one way");
  const auto time_s = ParseIsoTime(text);
  if (time_s) Require(ParseIsoTime(IsoTime(*time_s)) == time_s, "a time reads back equal");
}

// The first line: the values as JSON.
void TryFilling(const std::string& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  if (!CheckJsonText(text.substr(0, end)).ok()) return;
  const Json values = Json::parse(text.substr(0, end), nullptr, false);
  const std::string pattern = end < text.size() ? text.substr(end + 1) : "";
  const auto fault = TextFault(pattern);
  if (fault) Require(!fault->empty(), "a fault of a text says something");
  if (fault || values.is_discarded()) return;
  static_cast<void>(FillText(pattern, values));
  for (const TextName& name : PlacesInText(pattern))
    Require(NamesInText(pattern).contains(name.name), "every place has its name");
}

// Two doubles, bit by bit.
void TryRounding(const std::string& text) {
  double value = 0, uncertainty = 0;
  if (text.size() < 2 * sizeof(double)) return;
  std::memcpy(&value, text.data(), sizeof value);
  std::memcpy(&uncertainty, text.data() + sizeof value, sizeof uncertainty);
  if (!std::isfinite(value) || !std::isfinite(uncertainty) || !(uncertainty > 0)) return;
  const PrintedResult printed = PrintWithUncertainty(value, uncertainty);
  const auto read = ParseDouble(printed.value), read_u = ParseDouble(printed.uncertainty);
  Require(read.has_value() && read_u.has_value(), "printed results are numbers");
  // The place is at most a tenth of the uncertainty, or the 15th; rounding moves by half of it. The
  // other term is the precision of a double.
  const double limit = std::max(0.05 * uncertainty, 0.5e-15) + 4e-16 * std::abs(value);
  if (std::abs(value) < 1e15 * uncertainty)
    Require(std::abs(*read - value) <= 1.001 * limit, "rounding stays within the last place");
  static_cast<void>(PrintSignificant(value, 4));
  static_cast<void>(CoverageProbability(std::abs(value)));
}

}  // namespace

void FuzzText(std::string_view input) {
  if (input.empty()) return;
  const std::string text(input.substr(1));
  switch (input.front()) {
    case 'c':
      return TryTable(text);
    case 'n':
      return TryNumber(text);
    case 'u':
      return TryUnicode(text);
    case 't':
      return TryToml(text);
    case 'j':
      return TryJsonDepth(text);
    case 'd':
      return TryTime(text);
    case 'f':
      return TryFilling(text);
    case 'r':
      return TryRounding(text);
    default:
      return;
  }
}

}  // namespace telestrain::fuzz
