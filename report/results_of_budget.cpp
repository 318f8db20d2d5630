#include <array>
#include <cmath>
#include <string_view>

#include "base/numbers.h"
#include "report/results_parts.h"

namespace telestrain {
namespace {

// One measurand of the results: where its budget stands and what it is called.
struct Measurand {
  const char* table;  // id of its own table
  const char* title;  // of that table
  const char* name;   // in the table of all
  const char* budget;
  const char* key;  // of a standard uncertainty
  const char* unit;
};

constexpr Measurand kMagnification{"magnification-budget",
                                   "Uncertainty budget of the magnification",
                                   "Magnification",
                                   "/budget",
                                   "/standard_uncertainty_px_per_mm",
                                   "px/mm"};
constexpr Measurand kLength{"ruler-budget",
                            "Uncertainty budget of one length, RMS over the ruler images",
                            "Length of the ruler",
                            "/budget",
                            "/standard_uncertainty_um",
                            "µm"};
constexpr Measurand kStrain{"strain-budget",
                            "Uncertainty budget of one axial strain, RMS over the states",
                            "Axial strain",
                            "/budget",
                            "/standard_uncertainty_microstrain",
                            "µε"};
constexpr Measurand kDiameter{
    "diameter-budget",          "Uncertainty budget of the outer diameter",
    "Outer diameter",           "/geometry/budget",
    "/standard_uncertainty_um", "µm"};

// How the sources of the measurement model are evaluated (JCGM 100, 4.2 and 4.3): A by the scatter
// of observations, B by certificates and bounds.
const char* TypeOf(std::string_view source) {
  constexpr std::array<std::string_view, 4> kByScatter{"cross positions", "image noise",
                                                       "calibration", "scatter of the points"};
  constexpr std::array<std::string_view, 4> kByKnowledge{"target certificate", "ruler certificate",
                                                         "correlation bias", "temperature"};
  for (const std::string_view known : kByScatter)
    if (source == known) return "A";
  for (const std::string_view known : kByKnowledge)
    if (source == known) return "B";
  return source == "fibre" ? "A, B" : kNoValue;
}

struct BudgetRow {
  Json component;
  Json uncertainty;
  Json share;
  Json type;
};

// The components, what they give together (root sum of squares) and that times k. Empty when no
// component has a value.
std::vector<BudgetRow> RowsOf(const Json& lines, const char* key, const Acceptance& acceptance) {
  double variance = 0;
  for (const Json& line : lines) variance += std::pow(NumberAt(line, key).value_or(0), 2);
  std::vector<BudgetRow> rows;
  if (!(variance > 0)) return rows;
  for (const Json& line : lines) {
    const auto u = NumberAt(line, key);
    const auto share = u ? std::optional<double>(100 * *u * *u / variance) : std::nullopt;
    const std::string source = TextAt(line, "/source", "?");
    rows.push_back({source, UncertaintyCell(u), FixedCell(share, 1), TypeOf(source)});
  }
  const double combined = std::sqrt(variance);
  rows.push_back(
      {"Combined standard uncertainty", UncertaintyCell(combined), FixedCell(100, 1), kNoValue});
  rows.push_back({Phrase("Expanded uncertainty U (k = {{k}})",
                         {{"k", FormatShortest(acceptance.coverage_factor)}}),
                  UncertaintyCell(acceptance.Expanded(combined)), FixedCell({}, 0), kNoValue});
  return rows;
}

void AddMeasurand(const Measurand& measurand, const Json& results, const Acceptance& acceptance,
                  ResultTable& all, ResultsDraft& draft) {
  ResultTable table(
      measurand.table, measurand.title,
      {{"Component", ""}, {"Standard uncertainty", measurand.unit}, {"Share", "%"}, {"Type", ""}});
  for (const BudgetRow& row :
       RowsOf(ListAt(results, measurand.budget), measurand.key, acceptance)) {
    table.AddRow({row.component, row.uncertainty, row.share, row.type});
    all.AddRow(
        {measurand.name, row.component, row.uncertainty, measurand.unit, row.share, row.type});
  }
  if (!table.empty()) draft.AddTable(std::move(table));
}

// Of the lens: what the scatter of the corners gives, the rest of it is the certificate's.
Json BudgetOfMagnification(const Json& calibration) {
  constexpr const char* kVariance = "/0/0";  // the first parameter of the covariances
  Json results = Json::object();
  if (TextAt(calibration, "/covariance/parameters/0") != "magnification_px_per_mm") return results;
  const auto all = NumberAt(calibration, std::string("/covariance/matrix") + kVariance),
             noise = NumberAt(calibration, std::string("/covariance/matrix_of_noise") + kVariance);
  if (!all || !noise || *noise < 0 || *all < *noise) return results;
  for (const auto& [source, variance] :
       {std::pair{"cross positions", *noise}, std::pair{"target certificate", *all - *noise}})
    results["budget"].push_back(
        {{"source", source}, {"standard_uncertainty_px_per_mm", std::sqrt(variance)}});
  return results;
}

}  // namespace

void AddBudgets(const Json& calibration, const Json& ruler, const Json& strain,
                ResultsDraft& draft) {
  ResultTable all("budget", "Uncertainty budgets",
                  {{"Measurand", ""},
                   {"Component", ""},
                   {"Standard uncertainty", ""},
                   {"Unit", ""},
                   {"Share", "%"},
                   {"Type", ""}});
  AddMeasurand(kMagnification, BudgetOfMagnification(calibration), draft.acceptance, all, draft);
  AddMeasurand(kLength, ruler, draft.acceptance, all, draft);
  AddMeasurand(kStrain, strain, draft.acceptance, all, draft);
  AddMeasurand(kDiameter, strain, draft.acceptance, all, draft);
  if (all.empty()) return;
  draft.AddTable(std::move(all));
  draft.sentences["budget"] =
      "Components are standard uncertainties; the combined one is the root of the sum of their "
      "squares (JCGM 100), a share is that of the variance. Type A is evaluated by the scatter of "
      "observations, type B by certificates and bounds.";
}

}  // namespace telestrain
