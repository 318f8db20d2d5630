#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measurement/decision.h"
#include "report/json_lookup.h"

namespace telestrain {

// The pieces of results.json. A cell is a text, or {value, printed} with what the PDF prints, or a
// Phrase.

// A sentence with values in it, as {"printed", "pattern", "values"}. `pattern` is English with
// {{name}}s and the key of its translation (templates/texts); `printed` is the English result. A
// value is a text, or a Phrase, which is translated in its turn.
Json Phrase(const std::string& pattern, const std::map<std::string, Json>& values);
// The Phrase of a finished sentence of another module: every word with a digit in it is a value
// ("v1", "v2", …; numbers, names of images and views), so that the pattern is the same for all
// sentences of its kind. A sentence without such a word stays a plain text.
Json PhraseOfText(const std::string& text);
// The name of a lens model, "aspect k1 p1 telecentricity, bow of the boards", with its parts said
// each by itself.
Json ModelPhrase(const std::string& model);
// Texts and Phrases one after the other as one Phrase; empty ones are left out. A plain "" when
// none is left, the text itself when it is the only one.
Json JoinPhrases(const std::vector<Json>& parts, const std::string& separator = " ");
// What a text, a Phrase or a cell prints.
std::string PrintedText(const Json& text);

// Printed where a value does not exist.
inline constexpr const char* kNoValue = "–";

// A number with `decimals` places, or kNoValue.
Json FixedCell(std::optional<double> value, int decimals);
// A number with `digits` significant digits, or kNoValue.
Json SignificantCell(std::optional<double> value, int digits);
// An uncertainty without its value beside it, rounded after the GUM, or kNoValue.
Json UncertaintyCell(std::optional<double> uncertainty);
// A given, not measured number: all its digits, or kNoValue.
Json ExactCell(std::optional<double> value);
// A whole number, or kNoValue.
Json CountCell(std::optional<double> value);
// "(value ± U)" rounded after the GUM, or `fallback` when there is no uncertainty.
Json UncertainCell(double value, std::optional<double> expanded_uncertainty, const Json& fallback);
// The value and its U as two cells, rounded together after the GUM; without an uncertainty the
// value has `decimals` places and the second cell is kNoValue.
struct ResultCellPair {
  Json value;
  Json uncertainty;
};
ResultCellPair ResultCells(std::optional<double> value, std::optional<double> expanded_uncertainty,
                           int decimals);
// {verdict, printed "✓ pass"}; kNoValue for undecided.
Json VerdictCell(Verdict verdict);

struct ResultColumn {
  Json name;  // a text or a Phrase
  std::string unit;
};

// A table under construction.
class ResultTable {
 public:
  ResultTable(std::string id, std::string title, std::vector<ResultColumn> columns);
  void AddRow(std::vector<Json> cells);  // as many as there are columns
  // Prints the numbers of these columns anew at one decimal place, that of DecimalsOfColumn.
  void AlignDecimals(const std::vector<double>& expanded_uncertainties,
                     const std::vector<std::size_t>& columns);
  // The same by the uncertainties of the column `uncertainty`, which is aligned, too.
  void AlignDecimals(std::size_t uncertainty, std::vector<std::size_t> columns);
  // The last row leads to this section of the report: "row_links" has one entry per row, null where
  // none is set.
  void LinkLastRow(const std::string& section);
  // For tables of the form name, value, unit.
  void AddFact(Json name, Json value, const std::string& unit = "");
  bool empty() const { return json_["rows"].empty(); }
  Json TakeJson() { return std::move(json_); }

 private:
  Json json_;
};

// A table with the columns of AddFact.
ResultTable FactTable(std::string id, std::string title);

// One scalar result. Empty limit: nothing to decide. Empty verdict: not decided.
struct Quantity {
  std::string id;
  std::string section;
  Json label;  // a text or a Phrase
  std::string unit;
  std::optional<double> value;
  std::optional<double> expanded_uncertainty;
  // The quantity is one that must come with an uncertainty: without it nothing is decided. False
  // for those that have none by their nature (an RMS of residuals), which are compared directly.
  bool has_uncertainty = false;
  std::optional<double> limit;
  std::string limit_kind = "max_abs";  // or "max" for a quantity that cannot be negative
  std::optional<Verdict> verdict;
  // A check of our own: it can fail the report, but to pass it accepts nothing.
  bool is_check = false;
  int decimals = 3;             // when there is no uncertainty
  bool in_summary = true;       // a row of the report's first table
  bool is_drawing_aid = false;  // of a chart, no result
};

// A result without a limit that has its own place in the report, and is in the list of quantities
// for those who compare reports.
struct PlainResult {
  const char* id;
  const char* section;
  const char* label;
  const char* unit;
  int decimals;  // when there is no uncertainty
};

// What the session wants decided, and how.
struct Acceptance {
  std::optional<double> reprojection_rms_px;
  std::optional<double> ruler_mpe_um;
  std::optional<double> strain_error_microstrain;
  double coverage_factor = 2;
  DecisionRule rule = DecisionRule::kGuarded;

  std::optional<double> Expanded(std::optional<double> standard_uncertainty) const;
  // The verdict of a quantity whose limit, value and, if it has one, uncertainty are there;
  // nothing otherwise.
  std::optional<Verdict> DecideQuantity(const Quantity& quantity) const;
};

// results.json under construction: every section adds its part.
struct ResultsDraft {
  Acceptance acceptance;
  std::vector<Quantity> quantities;
  Json tables = Json::array();
  Json measured = Json::object();   // section -> bool
  Json diagnosis = Json::object();  // sentences of the diagnosis, texts or Phrases
  Json sentences = Json::object();  // of the other sections

  void AddTable(ResultTable table) { tables.push_back(table.TakeJson()); }
  // Adds it when it has a value.
  void AddPlain(const PlainResult& result, std::optional<double> value,
                std::optional<double> expanded_uncertainty);
  // Decides the quantity by its limit if it has no verdict yet.
  void AddQuantity(Quantity quantity);
};

// The verdict of a quantity with a limit in words, by its margin.
Json DecisionWords(const Quantity& quantity, const Acceptance& acceptance);

// The quantity as it stands in results.json.
Json QuantityJson(const Quantity& quantity, double coverage_factor);

}  // namespace telestrain
