#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "report/results_parts.h"
#include "report/rounding.h"

namespace telestrain {
namespace {

constexpr double kMetresPerMm = 1e-3;

struct RulerErrors {
  double count = 0;
  std::optional<double> rmse_um, max_um;
};

// Of the telecentric model: the lengths that the ruler's own acceptance measured.
RulerErrors ErrorsOf(const Json& ruler) {
  RulerErrors errors;
  double squares_um2 = 0, max_um = 0;
  for (const Json& image : ListAt(ruler, "/images")) {
    const auto error_um = NumberAt(image, "/error_um");
    if (!error_um) continue;
    errors.count += 1;
    squares_um2 += *error_um * *error_um;
    max_um = std::max(max_um, std::abs(*error_um));
  }
  if (errors.count == 0) return errors;
  errors.rmse_um = std::sqrt(squares_um2 / errors.count);
  errors.max_um = max_um;
  return errors;
}

// The arms' ruler images are those of the acceptance: else the two are not compared.
RulerErrors ComparableErrors(const Json& pinhole, const Json& ruler) {
  const RulerErrors errors = ErrorsOf(ruler);
  for (const Json& arm : ListAt(pinhole, "/arms"))
    if (NumberAt(arm, "/ruler_images").value_or(0) != errors.count) return {};
  return errors;
}

bool HasCoefficients(const Json& arm) {
  return NumberAt(arm, "/distortion_coefficients").value_or(0) > 0;
}

std::optional<double> DistanceOf_m(const Json& arm) {
  const auto distance_mm = NumberAt(arm, "/working_distance_mm");
  return distance_mm ? std::optional<double>(kMetresPerMm * *distance_mm) : std::nullopt;
}

Json StartsText(const Json& arm) {
  const auto starts = NumberAt(arm, "/starts"), wrong = NumberAt(arm, "/wrong_minima");
  if (!starts || *starts == 0 || !wrong) return kNoValue;
  return Phrase("{{wrong}} of {{starts}}",
                {{"wrong", FormatFixed(*wrong, 0)}, {"starts", FormatFixed(*starts, 0)}});
}

// The columns stand in the order that pinhole_charts.cpp reads.
void AddArms(const Json& pinhole, const RulerErrors& telecentric_um, ResultsDraft& draft) {
  ResultTable table("pinhole", "Telecentric against pinhole",
                    {{"Model", ""},
                     {"D", "m"},
                     {"Coefficients", ""},
                     {"Solver", ""},
                     {"RMS", "px"},
                     {"Mean", "px"},
                     {"Max", "px"},
                     {"Ruler RMSE", "µm"},
                     {"Ruler max", "µm"},
                     {"Converged", ""},
                     {"Wrong minima", ""}});
  const auto add = [&](const Json& arm, const char* model, const RulerErrors& ruler) {
    const auto pixels = [&](const char* pointer) { return FixedCell(NumberAt(arm, pointer), 4); };
    const Json& converged = EntryAt(arm, "/converged");
    table.AddRow({model, ExactCell(DistanceOf_m(arm)),
                  CountCell(NumberAt(arm, "/distortion_coefficients")),
                  TextAt(arm, "/solver", "telestrain"), pixels("/rms_px"), pixels("/mean_px"),
                  pixels("/max_px"), FixedCell(ruler.rmse_um, 3), FixedCell(ruler.max_um, 3),
                  converged == false ? "no" : "yes", StartsText(arm)});
  };
  add(EntryAt(pinhole, "/telecentric"), "telecentric", telecentric_um);
  for (const Json& arm : ListAt(pinhole, "/arms"))
    add(arm, "pinhole", {0, NumberAt(arm, "/ruler_rmse_um"), NumberAt(arm, "/ruler_max_um")});
  draft.AddTable(std::move(table));
}

// The arm with the smallest number at `pointer` among all, or those without coefficients.
const Json& BestArm(const Json& pinhole, const char* pointer, bool plain_only) {
  const Json* best = &EntryAt(pinhole, "/none");
  for (const Json& arm : ListAt(pinhole, "/arms")) {
    const auto value = NumberAt(arm, pointer);
    if (!value || (plain_only && HasCoefficients(arm))) continue;
    if (best->is_null() || *value < *NumberAt(*best, pointer)) best = &arm;
  }
  return *best;
}

Json NameOf(const Json& arm) {
  const auto distance_m = DistanceOf_m(arm);
  const std::map<std::string, Json> values{
      {"distance", distance_m ? FormatShortest(*distance_m) + " m" : "unknown"}};
  return Phrase(HasCoefficients(arm) ? "D = {{distance}}, five coefficients" : "D = {{distance}}",
                values);
}

Json ReprojectionSentence(const Json& pinhole) {
  const Json& best = BestArm(pinhole, "/rms_px", true);
  const auto telecentric_px = NumberAt(pinhole, "/telecentric/rms_px");
  if (best.is_null() || !telecentric_px) return "The pinhole cameras could not be compared.";
  if (const auto from_mm = NumberAt(pinhole, "/as_good_from_mm"))
    return Phrase(
        "Reprojection: from D = {{distance}} m on a pinhole without coefficients is as good as the "
        "telecentric model, within 1 % of its RMS. Parallel rays are the limit of a distant "
        "pinhole: far enough away it is a telecentric camera.",
        {{"distance", FormatShortest(kMetresPerMm * *from_mm)}});
  return Phrase(
      "Reprojection: no pinhole without coefficients comes within 1 % of the telecentric RMS of "
      "{{telecentric}} px; the best one ({{arm}}) has {{pinhole}} px. A distant pinhole is a "
      "telecentric camera, but each has a principal point of its own, so none has the distortion "
      "of the one lens that all views share.",
      {{"telecentric", FormatFixed(*telecentric_px, 4)},
       {"arm", NameOf(best)},
       {"pinhole", FormatFixed(*NumberAt(best, "/rms_px"), 4)}});
}

Json RulerSentence(const Json& pinhole, const RulerErrors& telecentric) {
  const Json& best = BestArm(pinhole, "/ruler_rmse_um", false);
  if (best.is_null() || !telecentric.rmse_um) return "";
  const double best_um = *NumberAt(best, "/ruler_rmse_um");
  return Phrase(
      best_um <= *telecentric.rmse_um
          ? "Ruler: the smallest RMSE of a pinhole is {{pinhole}} µm ({{arm}}), no larger "
            "than that of the telecentric model of {{telecentric}} µm; ruler images: "
            "{{count}}."
          : "Ruler: the smallest RMSE of a pinhole is {{pinhole}} µm ({{arm}}), that of "
            "the telecentric model is {{telecentric}} µm; ruler images: {{count}}.",
      {{"pinhole", FormatFixed(best_um, 3)},
       {"arm", NameOf(best)},
       {"telecentric", FormatFixed(*telecentric.rmse_um, 3)},
       {"count", FormatFixed(telecentric.count, 0)}});
}

}  // namespace

void AddPinhole(const Json& pinhole, const Json& ruler, ResultsDraft& draft) {
  draft.measured["pinhole"] = !ListAt(pinhole, "/arms").empty();
  if (draft.measured["pinhole"] == false) {
    draft.diagnosis["printed_pinhole"] = Phrase(
        "Not compared with pinhole cameras: {{reason}}.",
        {{"reason", PhraseOfText(TextAt(pinhole, "/missing_because",
                                        "mrcal.json gives neither a result nor a reason"))}});
    return;
  }
  const RulerErrors telecentric = ComparableErrors(pinhole, ruler);
  AddArms(pinhole, telecentric, draft);
  draft.diagnosis["printed_pinhole"] =
      JoinPhrases({ReprojectionSentence(pinhole), RulerSentence(pinhole, telecentric)});
}

}  // namespace telestrain
