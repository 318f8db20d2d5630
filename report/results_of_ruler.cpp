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

// `acceptance` holds where the ruler of this image was; null in results of older versions.
std::vector<Json> RulerRow(const Json& image, const Quantity& error, const Json& acceptance) {
  const ResultCellPair cells = ResultCells(error.value, error.expanded_uncertainty, error.decimals);
  const Json& where = FindBy(ListAt(acceptance, "/images"), "image", TextAt(image, "/image"));
  return {TextAt(image, "/image", "?"),
          FixedCell(NumberAt(image, "/length_mm"), 5),
          cells.value,
          cells.uncertainty,
          VerdictCell(error.verdict.value_or(Verdict::kUndecided)),
          FixedCell(NumberAt(where, "/middle_in_array_mm/0"), 2),
          FixedCell(NumberAt(where, "/middle_in_array_mm/1"), 2),
          FixedCell(NumberAt(where, "/depth_mm"), 2),
          FixedCell(NumberAt(where, "/yaw_deg"), 2),
          FixedCell(NumberAt(where, "/pitch_deg"), 2)};
}

void AddSummary(const Json& ruler, ResultsDraft& draft) {
  ResultTable table = FactTable("ruler-summary", "Summary of the length errors");
  table.AddFact("Ruler length, certified", FixedCell(NumberAt(ruler, "/nominal_length_mm"), 5),
                "mm");
  table.AddFact("Positions measured", CountCell(NumberAt(ruler, "/summary/count")));
  table.AddFact("Mean error", FixedCell(NumberAt(ruler, "/summary/mean_error_um"), 3), "µm");
  table.AddFact("Standard deviation", FixedCell(NumberAt(ruler, "/summary/sd_error_um"), 3), "µm");
  table.AddFact("Largest |E|", FixedCell(NumberAt(ruler, "/summary/max_abs_error_um"), 3), "µm");
  draft.AddTable(std::move(table));
}

void AddBudget(const Json& ruler, ResultsDraft& draft) {
  ResultTable table("ruler-budget", "Uncertainty budget of one length",
                    {{"Source", ""}, {"Standard uncertainty", "µm"}});
  for (const Json& entry : ListAt(ruler, "/budget"))
    table.AddRow({TextAt(entry, "/source", "?"),
                  SignificantCell(NumberAt(entry, "/standard_uncertainty_um"), 2)});
  if (!table.empty()) draft.AddTable(std::move(table));
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
  AddSummary(ruler, draft);
  AddBudget(ruler, draft);
  AddRulerAcceptance(EntryAt(ruler, "/acceptance"), draft);
}

}  // namespace telestrain
