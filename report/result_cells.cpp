#include "report/result_cells.h"

#include <cmath>
#include <limits>

#include "base/check.h"
#include "base/numbers.h"
#include "report/rounding.h"

namespace telestrain {

namespace {

Json NumberOrNull(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

// An uncertainty that was computed from absurd numbers may be none.
bool IsPrintable(const std::optional<double>& uncertainty) {
  return uncertainty && std::isfinite(*uncertainty) && *uncertainty > 0;
}

std::string PrintedLimit(const Quantity& quantity) {
  if (!quantity.limit) return kNoValue;
  const std::string number = FormatShortest(*quantity.limit);
  return quantity.limit_kind == "max" ? "≤ " + number : "± " + number;
}

}  // namespace

Json FixedCell(std::optional<double> value, int decimals) {
  if (!value) return {{"value", nullptr}, {"printed", kNoValue}};
  return {{"value", *value}, {"printed", FormatFixed(*value, decimals)}};
}

Json SignificantCell(std::optional<double> value, int digits) {
  if (!value) return FixedCell({}, 0);
  return {{"value", *value}, {"printed", PrintSignificant(*value, digits)}};
}

Json UncertaintyCell(std::optional<double> uncertainty) {
  if (!uncertainty) return FixedCell({}, 0);
  return {{"value", *uncertainty}, {"printed", PrintUncertainty(*uncertainty)}};
}

Json ExactCell(std::optional<double> value) {
  if (!value) return FixedCell({}, 0);
  return {{"value", *value}, {"printed", FormatShortest(*value)}};
}

Json CountCell(std::optional<double> value) { return FixedCell(value, 0); }

Json UncertainCell(double value, std::optional<double> expanded_uncertainty, const Json& fallback) {
  if (!IsPrintable(expanded_uncertainty)) return fallback;
  const PrintedResult printed = PrintWithUncertainty(value, *expanded_uncertainty);
  return {{"value", value},
          {"expanded_uncertainty", *expanded_uncertainty},
          {"printed", "(" + printed.value + " ± " + printed.uncertainty + ")"}};
}

ResultCellPair ResultCells(std::optional<double> value, std::optional<double> expanded_uncertainty,
                           int decimals) {
  if (!value || !IsPrintable(expanded_uncertainty))
    return {FixedCell(value, decimals), FixedCell({}, 0)};
  const PrintedResult printed = PrintWithUncertainty(*value, *expanded_uncertainty);
  return {{{"value", *value}, {"printed", printed.value}},
          {{"value", *expanded_uncertainty}, {"printed", printed.uncertainty}}};
}

Json VerdictCell(Verdict verdict) {
  static constexpr const char* kPrinted[] = {"✓ pass", "? doubt", "✗ fail", kNoValue};
  return {{"verdict", VerdictName(verdict)}, {"printed", kPrinted[static_cast<int>(verdict)]}};
}

ResultTable::ResultTable(std::string id, std::string title, std::vector<ResultColumn> columns) {
  json_ = {{"id", std::move(id)}, {"title", std::move(title)}, {"columns", Json::array()}};
  for (const ResultColumn& column : columns)
    json_["columns"].push_back(Json{{"name", column.name}, {"unit", column.unit}});
  json_["rows"] = Json::array();
}

void ResultTable::AddRow(std::vector<Json> cells) {
  TELESTRAIN_CHECK(cells.size() == json_["columns"].size(), "one cell per column");
  json_["rows"].push_back(std::move(cells));
}

void ResultTable::AlignDecimals(const std::vector<double>& expanded_uncertainties,
                                const std::vector<std::size_t>& columns) {
  const auto decimals = DecimalsOfColumn(expanded_uncertainties);
  if (!decimals) return;
  for (Json& row : json_["rows"])
    for (const std::size_t column : columns)
      if (const auto value = NumberAt(row[column], "/value"))
        row[column]["printed"] = PrintAtDecimals(*value, *decimals);
}

void ResultTable::AlignDecimals(std::size_t uncertainty, std::vector<std::size_t> columns) {
  std::vector<double> uncertainties;
  for (const Json& row : json_["rows"])
    uncertainties.push_back(NumberAt(row[uncertainty], "/value").value_or(0));
  columns.push_back(uncertainty);
  AlignDecimals(uncertainties, columns);
}

void ResultTable::LinkLastRow(const std::string& section) {
  Json& links = json_["row_links"];
  while (links.size() < json_["rows"].size()) links.push_back(nullptr);
  links.back() = section;
}

void ResultTable::AddFact(Json name, Json value, const std::string& unit) {
  AddRow({std::move(name), std::move(value), unit});
}

ResultTable FactTable(std::string id, std::string title) {
  return {std::move(id), std::move(title), {{"Name", ""}, {"Value", ""}, {"Unit", ""}}};
}

std::optional<double> Acceptance::Expanded(std::optional<double> standard_uncertainty) const {
  if (!standard_uncertainty || *standard_uncertainty < 0) return {};
  return coverage_factor * *standard_uncertainty;
}

std::optional<Verdict> Acceptance::DecideQuantity(const Quantity& quantity) const {
  if (!quantity.limit || !quantity.value) return {};
  if (quantity.has_uncertainty && !quantity.expanded_uncertainty) return {};
  const double uncertainty = quantity.expanded_uncertainty.value_or(0);
  return Decide(*quantity.value, uncertainty, *quantity.limit, rule);
}

void ResultsDraft::AddPlain(const PlainResult& result, std::optional<double> value,
                            std::optional<double> expanded_uncertainty) {
  if (!value) return;
  Quantity quantity;
  quantity.id = result.id;
  quantity.section = result.section;
  quantity.label = result.label;
  quantity.unit = result.unit;
  quantity.value = value;
  quantity.expanded_uncertainty = expanded_uncertainty;
  quantity.decimals = result.decimals;
  quantity.in_summary = false;
  AddQuantity(std::move(quantity));
}

void ResultsDraft::AddQuantity(Quantity quantity) {
  if (!quantity.verdict) quantity.verdict = acceptance.DecideQuantity(quantity);
  quantities.push_back(std::move(quantity));
}

Json DecisionWords(const Quantity& quantity, const Acceptance& acceptance) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  const double uncertainty =
      quantity.expanded_uncertainty.value_or(quantity.has_uncertainty ? kMissing : 0);
  const bool decided = quantity.verdict.value_or(Verdict::kUndecided) != Verdict::kUndecided;
  const Decision decision =
      DecideInWords(decided ? quantity.value.value_or(kMissing) : kMissing, uncertainty,
                    quantity.limit.value_or(kMissing), acceptance.rule, quantity.unit);
  return Phrase(decision.pattern, {decision.values.begin(), decision.values.end()});
}

Json QuantityJson(const Quantity& quantity, double coverage_factor) {
  const ResultCellPair cells =
      ResultCells(quantity.value, quantity.expanded_uncertainty, quantity.decimals);
  const bool has_uncertainty = !cells.uncertainty["value"].is_null();
  const auto verdict = quantity.verdict.value_or(Verdict::kUndecided);
  return {{"id", quantity.id},
          {"section", quantity.section},
          {"label", quantity.label},
          {"value", NumberOrNull(quantity.value)},
          {"unit", quantity.unit},
          {"expanded_uncertainty", NumberOrNull(quantity.expanded_uncertainty)},
          {"coverage_factor", has_uncertainty ? Json(coverage_factor) : Json(nullptr)},
          {"limit", NumberOrNull(quantity.limit)},
          {"limit_kind", quantity.limit_kind},
          {"verdict", verdict == Verdict::kUndecided ? Json(nullptr) : Json(VerdictName(verdict))},
          {"printed", cells.value["printed"]},
          {"printed_uncertainty", cells.uncertainty["printed"]},
          {"printed_limit", PrintedLimit(quantity)}};
}

}  // namespace telestrain
