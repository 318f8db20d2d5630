#include <algorithm>
#include <cctype>

#include "base/numbers.h"
#include "report/dcc/dcc_parts.h"
#include "report/dcc/dsi_number.h"
#include "report/result_cells.h"

namespace telestrain {
namespace {

// The columns of a table of results.json, as printed.
struct Column {
  std::string name;
  std::string unit;
  std::vector<std::string> texts = {};  // one per row
  bool measured = false;                // holds values, not names such as "cycle 1"
};

std::vector<Column> ColumnsOf(const Json& table) {
  std::vector<Column> columns;
  for (const Json& column : ListAt(table, "/columns"))
    columns.push_back({PrintedAt(column, "/name"), PrintedAt(column, "/unit")});
  for (const Json& row : ListAt(table, "/rows"))
    for (std::size_t i = 0; i < columns.size() && i < row.size(); ++i) {
      columns[i].texts.push_back(PrintedOf(row[i]));
      columns[i].measured |= row[i].is_object() && row[i].contains("value");
    }
  return columns;
}

bool IsMissing(const std::string& text) { return text.empty() || text == kNoValue; }

bool IsNumeric(const Column& column) {
  const auto number = [](const std::string& text) { return DsiNumber(text, 0).has_value(); };
  return column.measured && std::any_of(column.texts.begin(), column.texts.end(), number) &&
         std::all_of(column.texts.begin(), column.texts.end(),
                     [&](const std::string& text) { return IsMissing(text) || number(text); });
}

bool IsUncertainty(const Column& column) { return column.name == "U" && IsNumeric(column); }

// The common word where PTB's list has one, and our own.
std::string RefType(const std::string& table, const std::string& column) {
  std::string type = "telestrain_" + table + (column.empty() ? "" : "_" + column);
  for (char& c : type)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  if (table == "ruler" && column == "Length") return "basic_measuredValue " + type;
  if (table == "ruler" && column == "E") return "basic_measurementError " + type;
  return type;
}

// Entries of an XML list are separated by blanks, so a blank within one becomes a no-break space.
std::string ListEntry(const std::string& text) {
  std::string entry;
  for (const char c : XmlText(IsMissing(text) ? kNoValue : text))
    entry += c == ' ' ? "\u00A0" : std::string(1, c);
  return entry;
}

std::string ListOf(const std::vector<std::string>& entries) {
  std::string list;
  for (const std::string& entry : entries) list += (list.empty() ? "" : " ") + entry;
  return list;
}

// A missing number is NaN, which the D-SI has for it. `units` has one entry or one per row.
std::string NumberList(const std::vector<std::string>& texts, const std::vector<DsiUnit>& units) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < texts.size(); ++i)
    numbers.push_back(
        DsiNumber(texts[i], units[units.size() == 1 ? 0 : i].power_of_ten).value_or("NaN"));
  return ListOf(numbers);
}

// The unit of the column, or one per row from the table's column "Unit"; empty: not of the D-SI.
std::vector<DsiUnit> UnitsOf(const Column& column, const std::vector<Column>& all) {
  const auto per_row = std::find_if(all.begin(), all.end(),
                                    [](const Column& other) { return other.name == "Unit"; });
  std::vector<DsiUnit> units;
  const bool own = !column.unit.empty() || per_row == all.end();
  for (const std::string& text : own ? std::vector{column.unit} : per_row->texts) {
    const auto unit = DsiUnitOf(text);
    if (!unit) return {};
    units.push_back(*unit);
  }
  return units;
}

void WriteUncertainties(DccXml& xml, const Column& column, const std::vector<DsiUnit>& units,
                        double coverage_factor) {
  const auto outer = xml.Open("si:measurementUncertaintyUnivariateXMLList");
  const auto inner = xml.Open("si:expandedMUXMLList");
  xml.Leaf("si:valueExpandedMUXMLList", NumberList(column.texts, units));
  xml.Leaf("si:coverageFactorXMLList", FormatShortest(coverage_factor));
  xml.Leaf("si:coverageProbabilityXMLList", CoverageProbability(coverage_factor));
  xml.Leaf("si:distributionXMLList", "normal");
}

// "✓ pass" in words.
std::string VerdictWord(const std::string& printed) {
  for (const char* word : {"pass", "doubt", "fail"})
    if (printed.ends_with(word)) return word;
  return "";
}

// What the rows of a table with verdicts are held against.
std::optional<double> LimitOf(const std::string& table, const Json& results) {
  const char* quantity = table == "ruler" ? "ruler_error" : "";
  return NumberAt(FindBy(ListAt(results, "/quantities"), "id", quantity), "/limit");
}

// Nothing when a row is not decided: the schema has no word for it.
std::string Conformities(const Column& column, const Column* verdicts,
                         std::optional<double> limit) {
  std::vector<std::string> words;
  for (std::size_t i = 0; verdicts && i < verdicts->texts.size(); ++i) {
    words.push_back(
        ConformityOf(VerdictWord(verdicts->texts[i]), ParseDouble(column.texts[i]), limit));
    if (words.back().empty()) return "";
  }
  return ListOf(words);
}

void WriteMetaData(DccXml& xml, const std::string& conformities, const std::string& unit) {
  const auto known = DsiUnitOf(unit);
  if (conformities.empty() && (!known || known->non_si.empty())) return;
  const auto list = xml.Open("dcc:measurementMetaData");
  const auto entry = xml.Open(
      "dcc:metaData", conformities.empty() ? DccXml::Attributes{}
                                           : DccXml::Attributes{{"refType", "basic_conformity"}});
  xml.Leaf("dcc:conformityXMLList", conformities);
  WriteNonSi(xml, unit);
}

// The columns behind `at` that belong to its number: U, and the verdict.
struct Companions {
  const Column* uncertainty = nullptr;
  const Column* verdict = nullptr;
  std::size_t count = 0;
};

Companions CompanionsOf(const std::vector<Column>& columns, std::size_t at, bool takes_u) {
  Companions companions;
  std::size_t next = at + 1;
  if (takes_u && next < columns.size() && IsUncertainty(columns[next]))
    companions.uncertainty = &columns[next++];
  if (next < columns.size() && columns[next].name == "Verdict")
    companions.verdict = &columns[next++];
  companions.count = next - at - 1;
  return companions;
}

class ColumnTable {
 public:
  ColumnTable(const Json& table, const Json& results)
      : id_(TextAt(table, "/id")),
        columns_(ColumnsOf(table)),
        coverage_factor_(CoverageFactorOf(results)),
        limit_(LimitOf(id_, results)) {}

  void Write(DccXml& xml) const {
    for (std::size_t at = 0; at < columns_.size(); ++at) {
      const Column& column = columns_[at];
      if (column.name == "Unit" || std::all_of(column.texts.begin(), column.texts.end(), IsMissing))
        continue;
      const auto quantity = xml.Open("dcc:quantity", {{"refType", RefType(id_, column.name)}});
      xml.Text("dcc:name", column.name);
      const auto units = UnitsOf(column, columns_);
      if (IsNumeric(column) && !units.empty()) {
        const Companions companions = CompanionsOf(columns_, at, HasDsiCoverage(coverage_factor_));
        WriteNumbers(xml, column, companions, units);
        at += companions.count;
      } else {
        WriteTexts(xml, column);
      }
    }
  }

 private:
  static void WriteTexts(DccXml& xml, const Column& column) {
    std::vector<std::string> entries;
    for (const std::string& text : column.texts) entries.push_back(ListEntry(text));
    xml.Leaf("dcc:charsXMLList", ListOf(entries));
  }

  void WriteNumbers(DccXml& xml, const Column& column, const Companions& companions,
                    const std::vector<DsiUnit>& units) const {
    {
      const auto list = xml.Open("si:realListXMLList");
      xml.Leaf("si:valueXMLList", NumberList(column.texts, units));
      std::vector<std::string> names;
      for (const DsiUnit& unit : units) names.push_back(unit.unit);
      xml.Leaf("si:unitXMLList", ListOf(names));
      if (companions.uncertainty)
        WriteUncertainties(xml, *companions.uncertainty, units, coverage_factor_);
    }
    WriteMetaData(xml, Conformities(column, companions.verdict, limit_), column.unit);
  }

  std::string id_;
  std::vector<Column> columns_;
  double coverage_factor_;
  std::optional<double> limit_;
};

// "(12.3 ± 0.4)" as value and uncertainty; any other text is the value.
std::pair<std::string, std::string> Split(const std::string& printed) {
  constexpr std::string_view kBetween = " ± ";
  const std::size_t at = printed.find(kBetween);
  if (at == std::string::npos || !printed.starts_with('(') || !printed.ends_with(')'))
    return {printed, ""};
  const std::size_t from = at + kBetween.size();
  return {printed.substr(1, at - 1), printed.substr(from, printed.size() - 1 - from)};
}

void WriteFact(DccXml& xml, const std::string& id, const Json& row, double coverage_factor) {
  const std::string name = PrintedOf(row[0]), printed = PrintedOf(row[1]), unit = PrintedOf(row[2]);
  const auto [value, uncertainty] = Split(printed);
  const DccNumber number{name, RefType(id, name), unit, value, uncertainty};
  const auto quantity = xml.Open("dcc:quantity", {{"refType", number.ref_types}});
  xml.Text("dcc:name", name);
  if (!IsDccNumber(number)) {
    xml.Text("dcc:noQuantity", unit.empty() ? printed : printed + " " + unit);
    return;
  }
  WriteSmallCoverage(xml, number, coverage_factor);
  WriteReal(xml, number, coverage_factor);
  if (DsiUnitOf(unit)->non_si.empty()) return;
  const auto list = xml.Open("dcc:measurementMetaData");
  const auto entry = xml.Open("dcc:metaData");
  WriteNonSi(xml, unit);
}

bool HoldsFacts(const std::vector<Column>& columns) {
  return columns.size() == 3 && columns[0].name == "Name" && columns[1].name == "Value" &&
         columns[2].name == "Unit";
}

}  // namespace

void WriteTable(DccXml& xml, const Json& table, const Json& results) {
  const std::vector<Column> columns = ColumnsOf(table);
  const Json& rows = ListAt(table, "/rows");
  if (columns.empty() || rows.empty()) return;
  const std::string id = TextAt(table, "/id");
  const double coverage_factor = CoverageFactorOf(results);
  const auto result = xml.Open("dcc:result", {{"refType", RefType(id, "")}});
  xml.Text("dcc:name", PrintedAt(table, "/title"));
  const auto data = xml.Open("dcc:data");
  const auto list = xml.Open("dcc:list");
  if (!HoldsFacts(columns)) return ColumnTable(table, results).Write(xml);
  for (const Json& row : rows)
    if (row.size() == 3 && !IsMissing(PrintedOf(row[1]))) WriteFact(xml, id, row, coverage_factor);
}

}  // namespace telestrain
