#include <algorithm>
#include <cmath>
#include <optional>

#include "report/error_plot.h"
#include "report/plot.h"
#include "report/report_charts.h"

namespace telestrain {
namespace {

// Columns of the table "strain-states" as MakeResults writes them.
constexpr const char *kCycle = "/1", *kCamera = "/3/value", *kAtGauges = "/7/value",
                     *kAtGaugesU = "/8/value", *kGauges = "/9/value", *kDifference = "/10/value";

struct State {
  std::string cycle;
  double at_gauges = 0;  // the camera's value that is compared with the gauges
  double expanded_uncertainty = 0;
  std::optional<double> gauges, difference;
};

std::vector<State> States(const ReportContext& context) {
  std::vector<State> states;
  for (const Json& row : ListAt(context.Table("strain-states"), "/rows"))
    if (const auto camera = NumberAt(row, kCamera))
      states.push_back({TextAt(row, kCycle), NumberAt(row, kAtGauges).value_or(*camera),
                        NumberAt(row, kAtGaugesU).value_or(0), NumberAt(row, kGauges),
                        NumberAt(row, kDifference)});
  return states;
}

std::vector<State> StatesWithGauges(const ReportContext& context) {
  std::vector<State> states = States(context);
  std::erase_if(states, [](const State& state) { return !state.gauges || !state.difference; });
  return states;
}

struct Range {
  double low = 0, high = 0;
  void Include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// A line fitted to camera over gauges, as the tables print it.
struct FittedLine {
  double slope = 1, intercept_microstrain = 0;
  std::string equation;
};

// `name` as it stands in the table, in the report's language.
const Json& ValueOf(const Json& table, const std::string& name) {
  for (const Json& row : ListAt(table, "/rows"))
    if (TextAt(row, "/0") == name) return EntryAt(row, "/1");
  return EntryAt(table, "/none");
}

// The regression with errors in both of the sequence, else the plain one of the comparison.
std::optional<FittedLine> Regression(const ReportContext& context) {
  const Json& sequence = context.Table("sequence");
  const Json& comparison = context.Table("strain-comparison");
  const auto say = [&](const char* name) { return context.layout.Say(name); };
  const bool weighted = !ValueOf(sequence, say("Slope, camera over gauges")).is_null();
  const Json& slope = weighted ? ValueOf(sequence, say("Slope, camera over gauges"))
                               : ValueOf(comparison, say("Slope of the regression"));
  const Json& intercept = weighted ? ValueOf(sequence, say("Intercept"))
                                   : ValueOf(comparison, say("Intercept of the regression"));
  const auto value = NumberAt(slope, "/value"), offset = NumberAt(intercept, "/value");
  if (!value || !offset) return {};
  return FittedLine{
      *value, *offset,
      "y = " + TextAt(slope, "/printed") + " x + " + TextAt(intercept, "/printed") + " µε"};
}

}  // namespace

Status DrawStrainStates(const ReportContext& context, const PageBox& box) {
  const std::vector<State> states = States(context);
  if (states.empty()) {
    DrawNoData(context, box);
    return {};
  }
  Range range;
  bool has_gauges = false;
  std::vector<double> x, y;
  for (const State& state : states) {
    range.Include(state.at_gauges - state.expanded_uncertainty);
    range.Include(state.at_gauges + state.expanded_uncertainty);
    range.Include(state.gauges.value_or(0));
    has_gauges = has_gauges || state.gauges.has_value();
    x.push_back(static_cast<double>(x.size()));
    y.push_back(state.at_gauges);
  }
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  Plot plot(context.flow, box,
            {translate("State, 0 is the reference"), -0.5, x.back() + 0.5, true, false},
            {translate("Axial strain / µε"), range.low, range.high});
  const Look& look = context.flow.look();
  const double size_pt = plot.MarkerSize_pt();
  plot.DrawCurve(x, y, {look.measured, 0.25 + 0.25 * size_pt});
  for (std::size_t i = 0; i < states.size(); ++i) {
    plot.DrawErrorBar(x[i], y[i], states[i].expanded_uncertainty, look.measured, size_pt);
    plot.DrawMarker(x[i], y[i], Marker::kDot, look.measured, size_pt);
    if (states[i].gauges)
      plot.DrawMarker(x[i], *states[i].gauges, Marker::kSquare, look.reference, 1.6 * size_pt);
  }
  std::vector<Plot::LegendEntry> legend = {
      {translate(has_gauges ? "camera at the gauges ± U" : "camera ± U"), Marker::kDot,
       look.measured}};
  if (has_gauges) legend.push_back({translate("gauges, change"), Marker::kSquare, look.reference});
  plot.DrawLegend(legend);
  return {};
}

// Camera over gauges with the line 1 : 1 and the fitted one.
Status DrawStrainGauges(const ReportContext& context, const PageBox& box) {
  const std::vector<State> states = StatesWithGauges(context);
  if (states.empty()) {
    DrawNoData(context, box);
    return {};
  }
  Range range;
  for (const State& state : states) {
    range.Include(state.at_gauges);
    range.Include(*state.gauges);
  }
  const double margin = 0.06 * (range.high - range.low);
  const double low = range.low - margin, high = range.high + margin;
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  Plot plot(context.flow, box, {translate("Gauges, change / µε"), low, high, false, false},
            {translate("Camera at the gauges / µε"), low, high, false, false});
  const Look& look = context.flow.look();
  const std::vector<double> ends{plot.x_low(), plot.x_high()};
  plot.DrawCurve(ends, ends, {look.reference, 0.9});
  std::vector<Plot::LegendEntry> legend{{translate("states"), Marker::kDot, look.measured},
                                        {"1 : 1", Marker::kDot, look.reference, true}};
  if (const auto line = Regression(context)) {
    const auto at = [&](double x) { return line->slope * x + line->intercept_microstrain; };
    plot.DrawCurve(ends, {at(ends[0]), at(ends[1])}, {look.measured, 1.2, Dash::kDashed});
    legend.push_back({translate("regression"), Marker::kDot, look.measured, true, Dash::kDashed});
    const TextStyle style{Face::kRegular, 7.5, look.ink};
    context.flow.pdf().DrawText(style, {plot.area().left_pt + 5, plot.area().top_pt() - 11},
                                line->equation);
  }
  for (const State& state : states) {
    plot.DrawErrorBar(*state.gauges, state.at_gauges, state.expanded_uncertainty, look.measured);
    plot.DrawMarker(*state.gauges, state.at_gauges, Marker::kDot, look.measured, 2);
  }
  plot.DrawLegend(legend);
  return {};
}

// Camera minus gauges of every state; the limit is one of the RMS over them.
Status DrawStrainErrors(const ReportContext& context, const PageBox& box) {
  const Look& look = context.flow.look();
  std::vector<ErrorPoint> points;
  double number = -1;
  for (const State& state : States(context)) {
    number += 1;
    if (state.gauges && state.difference)
      points.push_back(
          {number, *state.difference, state.expanded_uncertainty, Marker::kDot, look.measured});
  }
  ErrorChart chart;
  chart.x_label = "State, 0 is the reference";
  chart.y_label = "Camera - gauges / µε";
  chart.numbered = true;
  chart.legend = {{context.layout.Say("error ± U of the camera"), Marker::kDot, look.measured}};
  const Json& quantity = FindBy(ListAt(context.results, "/quantities"), "id", "strain_error");
  chart.limit = NumberAt(quantity, "/limit");
  chart.limit_text = context.layout.Say("limit of the RMS error") + " " +
                     TextAt(quantity, "/printed_limit") + " µε";
  return DrawErrorChart(context, box, points, chart);
}

// Camera minus gauges over the gauges' change; the unloading states of every cycle apart.
Status DrawStrainHysteresis(const ReportContext& context, const PageBox& box) {
  const Look& look = context.flow.look();
  std::vector<ErrorPoint> points;
  std::string cycle;
  double peak = 0, before = 0;
  bool unloading = false;
  for (const State& state : StatesWithGauges(context)) {
    const double gauges = *state.gauges;
    if (state.cycle != cycle) unloading = false, peak = 0;
    cycle = state.cycle;
    peak = std::max(peak, std::abs(gauges));
    // From the first state on that falls back by a tenth of what the cycle reached.
    unloading = unloading || (peak > 0 && std::abs(gauges) < std::abs(before) - 0.1 * peak);
    before = gauges;
    points.push_back({gauges, *state.difference, state.expanded_uncertainty,
                      unloading ? Marker::kSquare : Marker::kDot,
                      unloading ? look.reference : look.measured});
  }
  ErrorChart chart;
  chart.x_label = "Gauges, change / µε";
  chart.y_label = "Camera - gauges / µε";
  chart.legend = {{context.layout.Say("loading"), Marker::kDot, look.measured},
                  {context.layout.Say("unloading"), Marker::kSquare, look.reference}};
  return DrawErrorChart(context, box, points, chart);
}

}  // namespace telestrain
