#include <algorithm>
#include <array>
#include <cmath>

#include "report/results_parts.h"

namespace telestrain {
namespace {

// In these units the limits are about one, and what has none reads well.
constexpr double kLimitedPerOne = 1e6, kFreePerOne = 1e9;

struct Check {
  const char* id;
  const char* label;
  const char* value;  // JSON pointers into independent_optimum
  const char* limit;
  const char* unit;
  double units_per_one;
  bool always_in_summary;  // the others only when they did not pass
};

constexpr std::array<Check, 4> kChecks{
    {{"mrcal_optimum_difference", "Largest difference to mrcal's own optimum",
      "/max_residual_difference_px", "/limits/residual_difference_px", "10⁻⁶ px", kLimitedPerOne,
      true},
     {"mrcal_magnification_difference", "Magnifications at mrcal's own optimum, relative",
      "/max_magnification_difference", "/limits/magnification_difference", "10⁻⁹", kFreePerOne,
      false},
     {"mrcal_rotation_difference", "Rotations between the views at mrcal's own optimum",
      "/max_rotation_difference_rad", "/limits/rotation_difference_rad", "10⁻⁹ rad", kFreePerOne,
      false},
     {"mrcal_projection_difference", "Largest difference of mrcal's projection at our solution",
      "/evaluated_max_residual_difference_px", "/limits/residual_difference_px", "10⁻⁶ px",
      kLimitedPerOne, true}}};

std::optional<double> ScaledAt(const Json& json, const char* pointer, double units_per_one) {
  const auto value = NumberAt(json, pointer);
  return value ? std::optional<double>(units_per_one * *value) : std::nullopt;
}

// Places that show two significant digits.
int DecimalsOf(double value) {
  if (value <= 0) return 2;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(value))), 0, 9);
}

Quantity QuantityOf(const Check& check, const Json& optimum, const Acceptance& acceptance) {
  Quantity quantity;
  quantity.id = check.id;
  quantity.section = "diagnosis";
  quantity.label = check.label;
  quantity.unit = check.unit;
  quantity.limit_kind = "max";
  quantity.is_check = true;
  quantity.value = ScaledAt(optimum, check.value, check.units_per_one);
  quantity.limit = ScaledAt(optimum, check.limit, check.units_per_one);
  quantity.decimals = DecimalsOf(quantity.value.value_or(0));
  quantity.verdict = acceptance.DecideQuantity(quantity);
  quantity.in_summary = check.always_in_summary || quantity.verdict == Verdict::kFail;
  return quantity;
}

// mrcal.json may say that they disagree although every difference is small, as when mrcal did not
// converge. That must fail too, with its reason.
void FailUnlessAgreed(const Json& optimum, std::vector<Quantity>& quantities) {
  if (EntryAt(optimum, "/agrees") == true) return;
  for (const Quantity& quantity : quantities)
    if (quantity.verdict == Verdict::kFail) return;
  quantities.front().verdict = Verdict::kFail;
  Json& label = quantities.front().label;
  label = Phrase(EntryAt(optimum, "/mrcal_converged") == false
                     ? "{{quantity}} (mrcal did not converge)"
                     : "{{quantity}} (mrcal.json says that they disagree)",
                 {{"quantity", label}});
}

void AddCheckTable(const std::vector<Quantity>& quantities, ResultsDraft& draft) {
  ResultTable table(
      "mrcal-check", "Check against mrcal",
      {{"Compared", ""}, {"Difference", ""}, {"Limit", ""}, {"Unit", ""}, {"Verdict", ""}});
  for (const Quantity& quantity : quantities) {
    const Json json = QuantityJson(quantity, draft.acceptance.coverage_factor);
    table.AddRow({quantity.label,
                  {{"value", json["value"]}, {"printed", json["printed"]}},
                  {{"value", json["limit"]}, {"printed", json["printed_limit"]}},
                  quantity.unit,
                  VerdictCell(quantity.verdict.value_or(Verdict::kUndecided))});
  }
  draft.AddTable(std::move(table));
}

std::string YesOrNo(const Json& json) {
  return json == true ? "yes" : json == false ? "no" : kNoValue;
}

void AddCheckFacts(const Json& optimum, ResultsDraft& draft) {
  constexpr int kDigits = 4;  // by how much the two differ says the table above
  ResultTable table = FactTable("mrcal-facts", "What was compared");
  table.AddFact("Model of the optimum", TextAt(optimum, "/model", kNoValue));
  table.AddFact("RMS at our optimum of this model",
                SignificantCell(NumberAt(optimum, "/rms_px"), kDigits), "px");
  table.AddFact("RMS at mrcal's optimum",
                SignificantCell(NumberAt(optimum, "/mrcal_rms_px"), kDigits), "px");
  const double left_out = NumberAt(optimum, "/telecentricity_left_out_per_mm").value_or(0);
  if (left_out != 0) table.AddFact("Telecentricity left out", SignificantCell(left_out, 2), "1/mm");
  table.AddFact("Projection compared at", TextAt(optimum, "/evaluated", kNoValue));
  table.AddFact("mrcal converged", YesOrNo(EntryAt(optimum, "/mrcal_converged")));
  table.AddFact("Images", CountCell(NumberAt(optimum, "/images")));
  table.AddFact("Images left out", CountCell(NumberAt(optimum, "/images_left_out")));
  draft.AddTable(std::move(table));
}

void AddNotChecked(const Json& optimum, ResultsDraft& draft) {
  const Json reason = PhraseOfText(
      TextAt(optimum, "/missing_because", "mrcal.json gives neither a result nor a reason"));
  Quantity quantity;
  quantity.id = kChecks.front().id;
  quantity.section = "diagnosis";
  quantity.label = Phrase("{{quantity}} (not checked: {{reason}})",
                          {{"quantity", kChecks.front().label}, {"reason", reason}});
  quantity.unit = kChecks.front().unit;
  quantity.limit_kind = "max";
  draft.AddQuantity(std::move(quantity));
  draft.diagnosis["printed_mrcal"] =
      Phrase("Not checked against mrcal: {{reason}}.", {{"reason", reason}});
}

void AddOptimum(const Json& optimum, ResultsDraft& draft) {
  if (EntryAt(optimum, "/agrees").is_null()) return AddNotChecked(optimum, draft);
  std::vector<Quantity> quantities;
  for (const Check& check : kChecks)
    quantities.push_back(QuantityOf(check, optimum, draft.acceptance));
  FailUnlessAgreed(optimum, quantities);
  AddCheckTable(quantities, draft);
  AddCheckFacts(optimum, draft);
  const bool failed = std::any_of(quantities.begin(), quantities.end(),
                                  [](const Quantity& q) { return q.verdict == Verdict::kFail; });
  draft.diagnosis["printed_mrcal"] =
      failed ? "mrcal and this program DISAGREE: do not use this calibration before the reason is "
               "known."
             : "mrcal agrees.";
  for (Quantity& quantity : quantities) draft.AddQuantity(std::move(quantity));
}

// What the uncertainty of the calibration means for what is measured with it.
void AddUncertainty(const Json& uncertainty, ResultsDraft& draft) {
  const Json& means = EntryAt(uncertainty, "/means_for");
  if (!EntryAt(means, "/length_um").is_object()) return;
  constexpr std::array<std::array<const char*, 3>, 4> kRows{
      {{"A length between the middles of the fields", "/length_um", "µm"},
       {"Strain feigned by a shift of 0.1 mm", "/shift_microstrain", "µε"},
       {"Strain feigned by a turn of 0.1°", "/turn_microstrain", "µε"},
       {"Error of a true strain of 1000 µε", "/true_strain_microstrain", "µε"}}};
  ResultTable table("uncertainty",
                    "What the calibration's uncertainty means (one standard uncertainty)",
                    {{"For", ""},
                     {"By the noise of its images", ""},
                     {"With the target's certificate", ""},
                     {"Unit", ""}});
  for (const auto& [what, key, unit] : kRows)
    table.AddRow({what, SignificantCell(NumberAt(means, std::string(key) + "/of_noise"), 2),
                  SignificantCell(NumberAt(means, std::string(key) + "/of_everything"), 2), unit});
  draft.AddTable(std::move(table));
}

}  // namespace

void AddDiagnosis(const Json& diagnosis, const Json& ruler, ResultsDraft& draft) {
  draft.measured["diagnosis"] = diagnosis.is_object() && draft.measured["calibration"] == true;
  if (draft.measured["diagnosis"] == false) return;
  AddOptimum(EntryAt(diagnosis, "/independent_optimum"), draft);
  AddResidualDiagnosis(EntryAt(diagnosis, "/residuals"), draft);
  AddUncertainty(EntryAt(diagnosis, "/uncertainty"), draft);
  AddPinhole(EntryAt(diagnosis, "/pinhole"), ruler, draft);
}

}  // namespace telestrain
