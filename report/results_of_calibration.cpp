#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "report/results_parts.h"

namespace telestrain {
namespace {

constexpr int kPixelDecimals = 4;

Json PixelCell(const Json& json, const std::string& pointer) {
  return FixedCell(NumberAt(json, pointer), kPixelDecimals);
}

// The arrow that explains the scale of the residual field: a round length near half the RMS, so
// that the means of some ten residuals draw well below their neighbours.
void AddResidualArrow(double rms_px, ResultsDraft& draft) {
  constexpr double kLeast_px = 1e-12;  // doubles do not resolve places on a sensor more finely
  if (rms_px < kLeast_px) return;
  const double power = std::pow(10, std::floor(std::log10(rms_px / 2)));
  const double digit = rms_px / 2 / power;
  Quantity arrow;
  arrow.id = "residual_arrow";
  arrow.section = "calibration";
  arrow.label = "Key arrow of the residual field";
  arrow.unit = "px";
  arrow.limit_kind = "max";
  arrow.value = power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
  arrow.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(*arrow.value) + 1e-9)));
  arrow.in_summary = false;
  arrow.is_drawing_aid = true;
  draft.AddQuantity(arrow);
}

void AddReprojection(const Json& calibration, ResultsDraft& draft) {
  const Json& reprojection = EntryAt(calibration, "/reprojection");
  Quantity rms;
  rms.id = "reprojection_rms";
  rms.section = "calibration";
  rms.label = "Reprojection error, RMS";
  rms.unit = "px";
  rms.limit_kind = "max";
  rms.decimals = kPixelDecimals;
  rms.value = NumberAt(reprojection, "/rms_px");
  rms.limit = draft.acceptance.reprojection_rms_px;
  draft.AddQuantity(rms);
  if (!reprojection.is_object()) return;
  AddResidualArrow(rms.value.value_or(0), draft);
  ResultTable table = FactTable("reprojection", "Reprojection");
  table.AddFact("RMS of one coordinate", PixelCell(reprojection, "/rms_px"), "px");
  table.AddFact("RMS expected from the detection noise",
                PixelCell(reprojection, "/expected_rms_px"), "px");
  table.AddFact("Mean distance", PixelCell(reprojection, "/mean_px"), "px");
  table.AddFact("Largest distance", PixelCell(reprojection, "/max_px"), "px");
  const auto count = [&](const char* pointer) {
    return CountCell(NumberAt(reprojection, pointer));
  };
  const Json& validation = EntryAt(calibration, "/cross_validation");
  if (validation.is_object())
    table.AddFact("RMS of images left out of the fit", PixelCell(validation, "/rms_px"), "px");
  table.AddFact("Corners", TextAt(calibration, "/solver/corners", kNoValue));
  table.AddFact("Their noise", TextAt(calibration, "/solver/corner_noise", kNoValue));
  table.AddFact("Outliers", TextAt(calibration, "/solver/outliers", kNoValue));
  if (const auto weak = NumberAt(calibration, "/solver/corners_below_half_weight"))
    table.AddFact("Corners below half weight", CountCell(weak));
  table.AddFact("Corners used", count("/corners_used"));
  table.AddFact("Corners rejected", count("/corners_rejected"));
  table.AddFact("Boards used", count("/boards_used"));
  table.AddFact("Boards rejected", count("/boards_rejected"));
  draft.AddTable(std::move(table));
}

struct PoseSums {
  double corners = 0, square_sum_px2 = 0, max_px = 0;
  int boards = 0;
};

PoseSums SumBoards(const Json& pose) {
  PoseSums sums;
  for (const Json& board : ListAt(pose, "/boards")) {
    const double corners = NumberAt(board, "/corners").value_or(0);
    const double rms_px = NumberAt(board, "/rms_px").value_or(0);
    sums.corners += corners;
    sums.square_sum_px2 += corners * rms_px * rms_px;
    sums.max_px = std::max(sums.max_px, NumberAt(board, "/max_px").value_or(0));
    ++sums.boards;
  }
  return sums;
}

void AddPoses(const Json& calibration, ResultsDraft& draft) {
  ResultTable table("poses", "Target poses",
                    {{"Image", ""},
                     {"Pose", ""},
                     {"Stage", "mm"},
                     {"Boards", ""},
                     {"Corners", ""},
                     {"RMS", "px"},
                     {"Max", "px"},
                     {"Origin x", "mm"},
                     {"Origin y", "mm"},
                     {"Origin z", "mm"}});
  for (const Json& pose : ListAt(calibration, "/poses")) {
    const PoseSums sums = SumBoards(pose);
    const auto rms_px = sums.corners > 0
                            ? std::optional<double>(std::sqrt(sums.square_sum_px2 / sums.corners))
                            : std::nullopt;
    const auto fixed = [&](const char* pointer) { return FixedCell(NumberAt(pose, pointer), 3); };
    table.AddRow({TextAt(pose, "/image", "?"), TextAt(pose, "/pose", kNoValue), fixed("/stage_mm"),
                  CountCell(sums.boards), CountCell(sums.corners),
                  FixedCell(rms_px, kPixelDecimals), FixedCell(sums.max_px, kPixelDecimals),
                  fixed("/origin_in_array_mm/0"), fixed("/origin_in_array_mm/1"),
                  fixed("/origin_in_array_mm/2")});
  }
  if (!table.empty()) draft.AddTable(std::move(table));
}

using ImageAndView = std::pair<std::string, std::string>;

// What the calibration rejected: whole boards, except those that the detector rejected already (the
// calibration repeats them), and the outlier corners of boards that stay in use.
void AddRejectedByCalibration(const Json& calibration, const std::set<ImageAndView>& by_detector,
                              ResultTable& boards, ResultTable& corners) {
  for (const Json& entry : ListAt(calibration, "/rejected")) {
    const std::string image = TextAt(entry, "/image", "?"), view = TextAt(entry, "/view", kNoValue);
    const std::string reason = TextAt(entry, "/reason", "no reason given");
    if (EntryAt(entry, "/whole_board") == false)
      corners.AddRow({image, view, CountCell(NumberAt(entry, "/corners")), PhraseOfText(reason)});
    else if (by_detector.count({image, view}) == 0)
      boards.AddRow(
          {image, view, Phrase("calibration: {{reason}}", {{"reason", PhraseOfText(reason)}})});
  }
}

// Boards that the detector did not find, then those that the calibration rejected.
void AddBoards(const Json& calibration, const Json& detection, ResultsDraft& draft) {
  ResultTable counts("boards", "Boards found per view",
                     {{"View", ""}, {"Found", ""}, {"Not found", ""}, {"Corners", ""}});
  ResultTable rejected("boards-rejected", "Boards not used",
                       {{"Image", ""}, {"View", ""}, {"Reason", ""}});
  ResultTable corners("corners-rejected", "Corners not used",
                      {{"Image", ""}, {"View", ""}, {"Corners", ""}, {"Reason", ""}});
  std::set<ImageAndView> by_detector;
  std::vector<std::string> views;
  std::vector<std::array<double, 3>> sums;
  for (const Json& board : ListAt(detection, "/boards")) {
    const std::string view = TextAt(board, "/view", "?");
    const auto known = std::find(views.begin(), views.end(), view);
    const auto index = static_cast<std::size_t>(known - views.begin());
    if (known == views.end()) {
      views.push_back(view);
      sums.push_back({});
    }
    const bool found = EntryAt(board, "/found") == true;
    sums[index][found ? 0 : 1] += 1;
    sums[index][2] += NumberAt(board, "/corners").value_or(0);
    if (found) continue;
    by_detector.insert({TextAt(board, "/image", "?"), view});
    rejected.AddRow(
        {TextAt(board, "/image", "?"), view,
         Phrase("detection: {{reason}}", {{"reason", PhraseOfText(TextAt(board, "/rejected_because",
                                                                         "no reason given"))}})});
  }
  for (std::size_t i = 0; i < views.size(); ++i)
    counts.AddRow({views[i], CountCell(sums[i][0]), CountCell(sums[i][1]), CountCell(sums[i][2])});
  AddRejectedByCalibration(calibration, by_detector, rejected, corners);
  if (!counts.empty()) draft.AddTable(std::move(counts));
  if (!rejected.empty()) draft.AddTable(std::move(rejected));
  if (!corners.empty()) draft.AddTable(std::move(corners));
}

void AddStageDecision(const Json& calibration, ResultsDraft& draft) {
  const Json& stage = EntryAt(calibration, "/stage_decision");
  if (!stage.is_object()) return;
  ResultTable table = FactTable("stage", "Decision between the two-fold poses by the stage");
  table.AddFact("Pose pairs", CountCell(NumberAt(stage, "/pairs")));
  table.AddFact("Pairs that agree", CountCell(NumberAt(stage, "/agreeing")));
  table.AddFact("Margin", SignificantCell(NumberAt(stage, "/margin_px"), 3), "px");
  table.AddFact("Cost of the twin solution, ratio",
                SignificantCell(NumberAt(stage, "/twin_cost_ratio"), 3));
  const Json& agrees = EntryAt(stage, "/nominal_agrees");
  if (agrees.is_boolean())
    table.AddFact("Nominal geometry agrees", agrees.get<bool>() ? "yes" : "no");
  const Json& screening = EntryAt(calibration, "/branch_screening");
  if (screening.is_object()) {
    const auto spread = [&](const char* pointer) {
      return SignificantCell(NumberAt(screening, pointer), 2);
    };
    table.AddFact("Rotation between views varies by", spread("/spread_as_chosen_deg"), "°");
    table.AddFact("The same with one view flipped", spread("/spread_one_view_flipped_deg"), "°");
  }
  draft.AddTable(std::move(table));
}

void AddModels(const Json& calibration, ResultsDraft& draft) {
  constexpr double kLeastP = 1e-12;  // below it a normal tail says nothing any more
  ResultTable tests("model-tests", "Models tested",
                    {{"Asked for", ""},
                     {"Fitted with", ""},
                     {"Parameters", ""},
                     {"χ²", ""},
                     {"F", ""},
                     {"p", ""},
                     {"Needed", ""}});
  for (const Json& model : ListAt(calibration, "/model_tests")) {
    const Json& accepted = EntryAt(model, "/accepted");
    const auto p = NumberAt(model, "/p_value");
    tests.AddRow({TextAt(model, "/added", kNoValue), ModelPhrase(TextAt(model, "/model", "?")),
                  CountCell(NumberAt(model, "/parameters")), FixedCell(NumberAt(model, "/chi2"), 1),
                  SignificantCell(NumberAt(model, "/f_statistic"), 4),
                  p && *p < kLeastP ? Json("< 1e-12") : SignificantCell(p, 2),
                  !accepted.is_boolean() ? kNoValue
                  : accepted == true     ? "yes"
                                         : "no"});
  }
  if (!tests.empty()) draft.AddTable(std::move(tests));
  ResultTable gauge("gauge", "Gauge: what was held fixed", {{"Statement", ""}});
  for (const Json& statement : ListAt(calibration, "/gauge"))
    if (statement.is_string()) gauge.AddRow({PhraseOfText(statement.get<std::string>())});
  if (!gauge.empty()) draft.AddTable(std::move(gauge));
}

}  // namespace

void AddCalibration(const Json& calibration, const Json& detection, ResultsDraft& draft) {
  draft.measured["calibration"] = NumberAt(calibration, "/reprojection/rms_px").has_value();
  AddReprojection(calibration, draft);
  AddBoards(calibration, detection, draft);
  if (calibration.is_null()) return;
  AddLensAndViews(calibration, draft);
  AddPoses(calibration, draft);
  AddStageDecision(calibration, draft);
  AddModels(calibration, draft);
}

}  // namespace telestrain
