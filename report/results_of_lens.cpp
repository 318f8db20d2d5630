#include <cmath>

#include "report/results_parts.h"

namespace telestrain {
namespace {

constexpr int kPixelDecimals = 4;

// What a lens and a target have only when a test freed it.
void AddRareTerms(const Json& calibration, ResultTable& table) {
  const auto aspect = NumberAt(calibration, "/lens/aspect");
  if (aspect && *aspect != 1) table.AddFact("Aspect ratio v to u", FixedCell(aspect, 7));
  const auto lean = NumberAt(calibration, "/lens/telecentricity_per_mm");
  if (lean && *lean != 0)
    table.AddFact("Residual telecentricity", SignificantCell(*lean * 1e6, 4), "ppm/mm");
  for (const Json& board : ListAt(calibration, "/target/boards")) {
    const auto add = [&](const char* name, const char* pointer) {
      const auto bow_um = NumberAt(board, pointer);
      if (bow_um && *bow_um != 0)
        table.AddFact(Phrase(name, {{"board", TextAt(board, "/group", "?")}}), FixedCell(bow_um, 2),
                      "µm");
    };
    add("Bow of board {{board}} along x", "/bow_x_um");
    add("Bow of board {{board}} along y", "/bow_y_um");
  }
}

// Standard uncertainty of a parameter of the one lens, from the covariance.
std::optional<double> SigmaOf(const Json& calibration, const std::string& parameter) {
  const Json& names = EntryAt(calibration, "/covariance/parameters");
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != parameter) continue;
    const std::string at = "/" + std::to_string(i);
    const auto variance = NumberAt(calibration, "/covariance/matrix" + at + at);
    if (variance && *variance > 0) return std::sqrt(*variance);
  }
  return std::nullopt;
}

void AddDistortion(const Json& calibration, const Acceptance& acceptance, ResultTable& table) {
  constexpr double kPpm = 1e6;
  static const std::vector<std::pair<const char*, const char*>> kTerms = {{"k1_per_mm2", "ppm/mm²"},
                                                                          {"k2_per_mm4", "ppm/mm⁴"},
                                                                          {"k3_per_mm6", "ppm/mm⁶"},
                                                                          {"p1_per_mm", "ppm/mm"},
                                                                          {"p2_per_mm", "ppm/mm"}};
  bool is_distorted = false;
  for (const auto& [key, unit] : kTerms) {
    const auto value = NumberAt(calibration, std::string("/lens/distortion/") + key);
    if (!value || *value == 0) continue;
    is_distorted = true;
    std::optional<double> expanded_ppm;
    if (const auto sigma = SigmaOf(calibration, key))
      expanded_ppm = acceptance.Expanded(kPpm * *sigma);
    table.AddFact(Phrase("Distortion {{term}}", {{"term", std::string(key).substr(0, 2)}}),
                  UncertainCell(kPpm * *value, expanded_ppm, SignificantCell(kPpm * *value, 4)),
                  unit);
  }
  if (is_distorted)
    table.AddFact("Distortion maps from",
                  TextAt(calibration, "/lens/distortion_direction", kNoValue));
}

void AddLens(const Json& calibration, ResultsDraft& draft) {
  ResultTable table = FactTable("lens", "Lens as calibrated");
  if (const auto magnification = NumberAt(calibration, "/lens/magnification_px_per_mm")) {
    const auto expanded =
        draft.acceptance.Expanded(NumberAt(calibration, "/lens/sigma_magnification_px_per_mm"));
    draft.AddPlain({"magnification", "calibration", "Magnification", "px/mm", 4}, magnification,
                   expanded);
    table.AddFact("Magnification (U with the certificate of the pitch)",
                  UncertainCell(*magnification, expanded, FixedCell(magnification, 4)), "px/mm");
  }
  table.AddFact("Object side of one pixel",
                FixedCell(NumberAt(calibration, "/lens/object_side_um_per_px"), 4), "µm");
  table.AddFact("Estimated beside the magnification",
                ModelPhrase(TextAt(calibration, "/lens/model", kNoValue)));
  AddDistortion(calibration, draft.acceptance, table);
  AddRareTerms(calibration, table);
  table.AddFact("Distortion centre u", FixedCell(NumberAt(calibration, "/lens/center_px/0"), 1),
                "px");
  table.AddFact("Distortion centre v", FixedCell(NumberAt(calibration, "/lens/center_px/1"), 1),
                "px");
  draft.AddTable(std::move(table));
}

// Where every view has a lens of its own.
void AddLensOfEachView(const Json& calibration, ResultsDraft& draft) {
  ResultTable table("lens-of-view", "Lens of each view",
                    {{"View", ""},
                     {"Magnification", "px/mm"},
                     {"Aspect", ""},
                     {"k1", "1/mm²"},
                     {"k2", "1/mm⁴"},
                     {"p1", "1/mm"},
                     {"p2", "1/mm"}});
  for (const Json& view : ListAt(calibration, "/views")) {
    const Json& lens = EntryAt(view, "/lens");
    if (!lens.is_object()) continue;
    const auto term = [&](const char* pointer) {
      return SignificantCell(NumberAt(lens, pointer), 4);
    };
    table.AddRow({TextAt(view, "/name", "?"),
                  FixedCell(NumberAt(lens, "/magnification_px_per_mm"), 4),
                  FixedCell(NumberAt(lens, "/aspect"), 6), term("/distortion/k1_per_mm2"),
                  term("/distortion/k2_per_mm4"), term("/distortion/p1_per_mm"),
                  term("/distortion/p2_per_mm")});
  }
  if (!table.empty()) draft.AddTable(std::move(table));
}

void AddViews(const Json& calibration, ResultsDraft& draft) {
  ResultTable table("views", "Views as calibrated",
                    {{"View", ""},
                     {"Group", ""},
                     {"Corners", ""},
                     {"RMS", "px"},
                     {"Mean", "px"},
                     {"Eq. 6 m_x", "px/mm"},
                     {"Eq. 6 m_y", "px/mm"},
                     {"Offset u", "px"},
                     {"Offset v", "px"},
                     {"Axis x", ""},
                     {"Axis y", ""},
                     {"Axis z", ""}});
  for (const Json& view : ListAt(calibration, "/views")) {
    const auto fixed = [&](const char* pointer, int decimals) {
      return FixedCell(NumberAt(view, pointer), decimals);
    };
    table.AddRow({TextAt(view, "/name", "?"), TextAt(view, "/group", kNoValue),
                  CountCell(NumberAt(view, "/corners")), fixed("/rms_px", kPixelDecimals),
                  fixed("/mean_px", kPixelDecimals), fixed("/magnification_eq6_px_per_mm/0", 3),
                  fixed("/magnification_eq6_px_per_mm/1", 3), fixed("/offset_px/0", 2),
                  fixed("/offset_px/1", 2), fixed("/axis_in_array/0", 5),
                  fixed("/axis_in_array/1", 5), fixed("/axis_in_array/2", 5)});
  }
  draft.AddTable(std::move(table));
  AddLensOfEachView(calibration, draft);
}

}  // namespace

void AddLensAndViews(const Json& calibration, ResultsDraft& draft) {
  AddLens(calibration, draft);
  AddViews(calibration, draft);
}

}  // namespace telestrain
