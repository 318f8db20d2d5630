#include <cmath>

#include "report/results_parts.h"

namespace telestrain {
namespace {

struct LengthError {
  Quantity quantity;
  // Order of the summary row: the worst verdict first, then the largest |E| + U.
  std::pair<int, double> Badness() const {
    return {Severity(quantity.verdict.value_or(Verdict::kUndecided)),
            std::abs(*quantity.value) + quantity.expanded_uncertainty.value_or(0)};
  }
};

LengthError DecideImage(const Json& image, const Acceptance& acceptance) {
  LengthError error;
  error.quantity.id = "ruler_error";
  error.quantity.section = "ruler";
  error.quantity.unit = "µm";
  error.quantity.value = NumberAt(image, "/error_um");
  error.quantity.expanded_uncertainty =
      acceptance.Expanded(NumberAt(image, "/standard_uncertainty_um"));
  error.quantity.has_uncertainty = true;
  error.quantity.limit = acceptance.ruler_mpe_um;
  error.quantity.decimals = 2;
  error.quantity.label =
      Phrase("Length error E, worst image ({{image}})", {{"image", TextAt(image, "/image", "?")}});
  error.quantity.verdict = acceptance.DecideQuantity(error.quantity);
  return error;
}

// The length in mm, rounded by the U of its error, which is in um.
Json LengthCell(const Json& image, const Quantity& error) {
  const auto expanded_mm = error.expanded_uncertainty
                               ? std::optional<double>(*error.expanded_uncertainty / 1000)
                               : std::nullopt;
  return ResultCells(NumberAt(image, "/length_mm"), expanded_mm, 5).value;
}

// `acceptance` holds where the ruler of this image was; null in results of older versions.
std::vector<Json> RulerRow(const Json& image, const Quantity& error, const Json& acceptance) {
  const ResultCellPair cells = ResultCells(error.value, error.expanded_uncertainty, error.decimals);
  const Json& where = FindBy(ListAt(acceptance, "/images"), "image", TextAt(image, "/image"));
  return {TextAt(image, "/image", "?"),
          LengthCell(image, error),
          cells.value,
          cells.uncertainty,
          VerdictCell(error.verdict.value_or(Verdict::kUndecided)),
          FixedCell(NumberAt(where, "/middle_in_array_mm/0"), 2),
          FixedCell(NumberAt(where, "/middle_in_array_mm/1"), 2),
          FixedCell(NumberAt(where, "/depth_mm"), 2),
          FixedCell(NumberAt(where, "/yaw_deg"), 2),
          FixedCell(NumberAt(where, "/pitch_deg"), 2)};
}

// What the section on bias and spread states with its U has the same places here. `largest`: the
// image of the largest |E| + U.
void AddSummary(const Json& ruler, const Quantity& largest, ResultsDraft& draft) {
  const auto rounded = [&](const char* value, const char* expanded_uncertainty) {
    return ResultCells(NumberAt(ruler, value), NumberAt(ruler, expanded_uncertainty), 3).value;
  };
  ResultTable table = FactTable("ruler-summary", "Summary of the length errors");
  table.AddFact("Ruler length, certified", FixedCell(NumberAt(ruler, "/nominal_length_mm"), 5),
                "mm");
  table.AddFact("Positions measured", CountCell(NumberAt(ruler, "/summary/count")));
  table.AddFact("Mean error",
                rounded("/summary/mean_error_um", "/acceptance/bias_um/expanded_uncertainty"),
                "µm");
  table.AddFact("Standard deviation",
                rounded("/summary/sd_error_um", "/acceptance/spread_um/expanded_uncertainty"),
                "µm");
  table.AddFact(
      "Largest |E|",
      ResultCells(NumberAt(ruler, "/summary/max_abs_error_um"), largest.expanded_uncertainty, 3)
          .value,
      "µm");
  draft.AddTable(std::move(table));
}

void AddRejected(const Json& ruler, ResultsDraft& draft) {
  ResultTable table("ruler-rejected", "Ruler images not evaluated",
                    {{"Image", ""}, {"Reason", ""}});
  for (const Json& image : ListAt(ruler, "/images"))
    if (!NumberAt(image, "/error_um"))
      table.AddRow({TextAt(image, "/image", "?"),
                    PhraseOfText(TextAt(image, "/rejected_because", "no value"))});
  if (!table.empty()) draft.AddTable(std::move(table));
}

}  // namespace

void AddRuler(const Json& ruler, ResultsDraft& draft) {
  Quantity worst;
  worst.id = "ruler_error";
  worst.section = "ruler";
  worst.label = "Length error E, worst image";
  worst.unit = "µm";
  worst.has_uncertainty = true;
  worst.limit = draft.acceptance.ruler_mpe_um;
  ResultTable table("ruler", "Length error of every ruler image",
                    {{"Image", ""},
                     {"Length", "mm"},
                     {"E", "µm"},
                     {"U", "µm"},
                     {"Verdict", ""},
                     {"x", "mm"},
                     {"y", "mm"},
                     {"Depth", "mm"},
                     {"Yaw", "°"},
                     {"Pitch", "°"}});
  std::optional<LengthError> found;
  for (const Json& image : ListAt(ruler, "/images")) {
    if (!NumberAt(image, "/error_um")) continue;
    LengthError error = DecideImage(image, draft.acceptance);
    table.AddRow(RulerRow(image, error.quantity, EntryAt(ruler, "/acceptance")));
    if (!found || error.Badness() > found->Badness()) found = std::move(error);
  }
  draft.measured["ruler"] = found.has_value();
  draft.AddQuantity(found ? found->quantity : worst);
  if (ruler.is_null()) return;
  AddRejected(ruler, draft);
  if (!found) return;
  draft.AddTable(std::move(table));
  AddSummary(ruler, found->quantity, draft);
  AddRulerAcceptance(EntryAt(ruler, "/acceptance"), draft);
}

}  // namespace telestrain
