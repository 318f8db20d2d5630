#include <array>

#include "report/results_parts.h"
#include "report/rounding.h"

namespace telestrain {
namespace {

constexpr std::size_t kMostBoards = 10;
// The diagnosis calls a pattern or a distribution not noise below this (residual_pattern.h).
constexpr double kClearSign = 0.002;
constexpr double kWeakSign = 0.05;
constexpr double kLeastPrinted = 1e-12;

Json ProbabilityCell(std::optional<double> p) {
  if (!p || *p >= kLeastPrinted) return SignificantCell(p, 2);
  return {{"value", *p}, {"printed", "< 1e-12"}};
}

// What a probability says, when a small one speaks for `sign`.
Json PlainWords(std::optional<double> p, const char* sign) {
  if (!p) return "not tested";
  const char* words = *p >= kWeakSign    ? "No sign of {{sign}}."
                      : *p >= kClearSign ? "A weak sign of {{sign}}, as chance alone may give."
                                         : "A clear sign of {{sign}}.";
  return Phrase(words, {{"sign", sign}});
}

// The test of `list` with the smallest adjusted p, or null JSON.
const Json& Smallest(const Json& list) {
  const Json* smallest = &EntryAt(list, "/0");
  for (const Json& test : list)
    if (NumberAt(test, "/p_value").value_or(1) < NumberAt(*smallest, "/p_value").value_or(1))
      smallest = &test;
  return *smallest;
}

// `statistic` and where it was found.
Json AtPlace(const char* statistic, const Json& test) {
  if (!test.is_object()) return statistic;
  const std::string over = TextAt(test, "/over");
  const std::map<std::string, Json> values{{"statistic", statistic},
                                           {"view", TextAt(test, "/view", "?")},
                                           {"component", TextAt(test, "/component", "?")},
                                           {"over", over}};
  return Phrase(over.empty() ? "{{statistic}} (view {{view}}, {{component}})"
                             : "{{statistic}} (view {{view}}, {{component}}, {{over}})",
                values);
}

void AddTests(const Json& residuals, ResultsDraft& draft) {
  const Json& tests = EntryAt(residuals, "/tests");
  ResultTable table("residual-tests", "Are the residuals noise?",
                    {{"Test", ""}, {"Statistic", ""}, {"Value", ""}, {"p", ""}, {"Says", ""}});
  const auto add = [&](const char* test, const Json& statistic, std::optional<double> value,
                       std::optional<double> p, const Json& words) {
    table.AddRow({test, statistic, SignificantCell(value, 3), ProbabilityCell(p), words});
  };
  add("Size (chi-square)", "RMS over the corners' stated noise",
      NumberAt(tests, "/chi_square/sigma0"), NumberAt(tests, "/chi_square/p_value"),
      PhraseOfText(TextAt(residuals, "/verdict/size", "not tested")));
  const auto normality_p = NumberAt(tests, "/normality/p_value");
  add("Normality (Anderson-Darling)", "A²", NumberAt(tests, "/normality/statistic"), normality_p,
      PlainWords(normality_p, "another distribution"));
  const Json& spatial = Smallest(ListAt(tests, "/spatial"));
  const auto spatial_p = NumberAt(tests, "/smallest_spatial_p");
  add("Spatial (Moran's I)", AtPlace("I, least probable", spatial), NumberAt(spatial, "/morans_i"),
      spatial_p, PlainWords(spatial_p, "neighbours that err alike"));
  const Json& trend = Smallest(ListAt(tests, "/trends"));
  const auto trend_p = NumberAt(tests, "/smallest_trend_p");
  add("Trend over the images", AtPlace("change / px, least probable", trend),
      NumberAt(trend, "/change_px"), trend_p, PlainWords(trend_p, "a drift"));
  add("Directions", "mean resultant, 1 for one direction",
      NumberAt(residuals, "/directions/mean_resultant"), {}, "Shown in the figure below.");
  draft.AddTable(std::move(table));
}

void AddFindings(const Json& verdict, ResultsDraft& draft) {
  ResultTable table("residual-findings", "Findings and remedies",
                    {{"In", ""}, {"Finding", ""}, {"Remedy", ""}, {"RMS", "px"}, {"p", ""}});
  const auto add = [&](const char* pointer, const char* in) {
    for (const Json& finding : ListAt(verdict, pointer))
      table.AddRow({in, PhraseOfText(TextAt(finding, "/text", "?")),
                    PhraseOfText(TextAt(finding, "/remedy", kNoValue)),
                    SignificantCell(NumberAt(finding, "/rms_px"), 2),
                    ProbabilityCell(NumberAt(finding, "/adjusted_p_value"))});
  };
  add("/findings", "residuals");
  add("/boards_left_out", "board left out");
  if (!table.empty()) draft.AddTable(std::move(table));
}

void AddViews(const Json& residuals, ResultsDraft& draft) {
  ResultTable table("residual-views", "Residuals of each view",
                    {{"View", ""},
                     {"Corners", ""},
                     {"RMS of a coordinate", "px"},
                     {"RMS of a corner", "px"},
                     {"Mean", "px"},
                     {"Worst corner", "px"},
                     {"RMS / stated noise", ""}});
  const auto add = [&](const std::string& name, const Json& view) {
    table.AddRow({name, CountCell(NumberAt(view, "/corners")),
                  FixedCell(NumberAt(view, "/rms_px"), 4),
                  FixedCell(NumberAt(view, "/rms_per_corner_px"), 4),
                  SignificantCell(NumberAt(view, "/mean_px"), 2),
                  FixedCell(NumberAt(view, "/worst_corner_px"), 4),
                  FixedCell(NumberAt(view, "/rms_whitened"), 3)});
  };
  for (const Json& view : ListAt(residuals, "/views")) add(TextAt(view, "/view", "?"), view);
  add("all", residuals);
  draft.AddTable(std::move(table));
}

void AddBoards(const Json& residuals, ResultsDraft& draft) {
  ResultTable table("residual-boards", "Worst boards",
                    {{"Image", ""},
                     {"View", ""},
                     {"Corners", ""},
                     {"RMS of a corner", "px"},
                     {"Worst corner", "px"},
                     {"Its column", ""},
                     {"Its row", ""}});
  std::size_t rows = 0;
  for (const Json& board : ListAt(residuals, "/worst_boards")) {
    if (rows++ == kMostBoards) break;
    const auto count = [&](const char* pointer) { return CountCell(NumberAt(board, pointer)); };
    table.AddRow({TextAt(board, "/image", "?"), TextAt(board, "/view", "?"), count("/corners"),
                  FixedCell(NumberAt(board, "/rms_per_corner_px"), 4),
                  FixedCell(NumberAt(board, "/worst_corner_px"), 4), count("/worst_column"),
                  count("/worst_row")});
  }
  if (!table.empty()) draft.AddTable(std::move(table));
}

void AddOutlierReplay(const Json& replay, ResultsDraft& draft) {
  ResultTable table("outlier-replay", "mrcal's outlier rule, replayed",
                    {{"Pass", ""}, {"Sigma of the inliers", "px"}, {"Corners marked", ""}});
  double pass = 0;
  for (const Json& json : ListAt(replay, "/passes"))
    table.AddRow({CountCell(++pass), FixedCell(NumberAt(json, "/sigma_px"), 5),
                  CountCell(NumberAt(json, "/marked"))});
  if (!table.empty()) draft.AddTable(std::move(table));
}

}  // namespace

void AddResidualDiagnosis(const Json& residuals, ResultsDraft& draft) {
  const Json& verdict = EntryAt(residuals, "/verdict");
  draft.diagnosis["printed_verdict"] =
      JoinPhrases({PhraseOfText(TextAt(verdict, "/text", "No verdict on the residuals.")),
                   PhraseOfText(TextAt(verdict, "/size"))});
  if (!residuals.is_object()) return;
  AddTests(residuals, draft);
  AddFindings(verdict, draft);
  AddViews(residuals, draft);
  AddBoards(residuals, draft);
  AddOutlierReplay(EntryAt(residuals, "/outlier_replay"), draft);
}

}  // namespace telestrain
