#include "report/report_charts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "report/plot.h"

namespace telestrain {
namespace {

struct Sample {
  double value = 0;
  double expanded_uncertainty = 0;
  std::string verdict;
};

// Column numbers of the tables as MakeResults writes them.
constexpr const char *kRulerError = "/2/value", *kRulerU = "/3/value",
                     *kRulerVerdict = "/4/verdict";
constexpr const char *kCamera = "/3/value", *kCameraU = "/4/value", *kGauges = "/9/value",
                     *kAtGauges = "/7/value", *kAtGaugesU = "/8/value";

std::vector<Sample> RulerErrors(const ReportContext& context) {
  std::vector<Sample> samples;
  for (const Json& row : ListAt(context.Table("ruler"), "/rows"))
    if (const auto error = NumberAt(row, kRulerError))
      samples.push_back({*error, NumberAt(row, kRulerU).value_or(0), TextAt(row, kRulerVerdict)});
  return samples;
}

Marker MarkerOf(const std::string& verdict) {
  if (verdict == "doubt") return Marker::kDiamond;
  return verdict == "fail" ? Marker::kCross : Marker::kDot;
}

// The legend's wording and colour; "" for images that nothing decides about.
Color ColorOfSample(const Look& look, const std::string& verdict) {
  return verdict == "pass" || verdict == "doubt" || verdict == "fail" ? look.OfVerdict(verdict)
                                                                      : look.measured;
}

Status DrawRulerErrors(const ReportContext& context, const PageBox& box) {
  const std::vector<Sample> samples = RulerErrors(context);
  const Json& limit_row = FindBy(ListAt(context.results, "/quantities"), "id", "ruler_error");
  const auto limit = NumberAt(limit_row, "/limit");
  if (samples.empty()) {
    DrawNoData(context, box);
    return {};
  }
  double reach = 1.15 * limit.value_or(0);
  for (const Sample& sample : samples)
    reach = std::max(reach, 1.05 * (std::abs(sample.value) + sample.expanded_uncertainty));
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  const double last = static_cast<double>(samples.size()) + 0.5;
  Plot plot(context.flow, box, {translate("Ruler image, row of the table"), 0.5, last, true, false},
            {translate("E / µm"), -reach, reach});
  const Look& look = context.flow.look();
  plot.DrawCurve({plot.x_low(), plot.x_high()}, {0, 0}, {look.muted, 0.7});
  if (limit) {
    const std::string text = "MPE " + TextAt(limit_row, "/printed_limit") + " µm";
    plot.DrawLimit(*limit, text);
    plot.DrawLimit(-*limit, "");
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = static_cast<double>(i) + 1;
    const Color color = ColorOfSample(look, samples[i].verdict);
    const double size_pt = 1.15 * plot.MarkerSize_pt();
    plot.DrawErrorBar(x, samples[i].value, samples[i].expanded_uncertainty, color, size_pt);
    plot.DrawMarker(x, samples[i].value, MarkerOf(samples[i].verdict), color, size_pt);
  }
  std::vector<Plot::LegendEntry> legend;
  for (const char* verdict : {"pass", "doubt", "fail"})
    if (std::any_of(samples.begin(), samples.end(),
                    [&](const Sample& s) { return s.verdict == verdict; }))
      legend.push_back(
          {"E ± U, " + context.layout.Say(verdict), MarkerOf(verdict), look.OfVerdict(verdict)});
  if (legend.empty()) legend.push_back({"E ± U", Marker::kDot, look.measured});
  plot.DrawLegend(legend);
  return {};
}

struct State {
  Sample camera;
  Sample at_gauges;  // the camera's value that is compared with them
  std::optional<double> gauges;
};

std::vector<State> States(const ReportContext& context) {
  std::vector<State> states;
  for (const Json& row : ListAt(context.Table("strain-states"), "/rows"))
    if (const auto camera = NumberAt(row, kCamera))
      states.push_back(
          {{*camera, NumberAt(row, kCameraU).value_or(0), ""},
           {NumberAt(row, kAtGauges).value_or(*camera), NumberAt(row, kAtGaugesU).value_or(0), ""},
           NumberAt(row, kGauges)});
  return states;
}

Status DrawStrainStates(const ReportContext& context, const PageBox& box) {
  const std::vector<State> states = States(context);
  if (states.empty()) {
    DrawNoData(context, box);
    return {};
  }
  double low = 0, high = 0;
  bool has_gauges = false;
  std::vector<double> x, y;
  for (const State& state : states) {
    low = std::min({low, state.at_gauges.value - state.at_gauges.expanded_uncertainty,
                    state.gauges.value_or(0)});
    high = std::max({high, state.at_gauges.value + state.at_gauges.expanded_uncertainty,
                     state.gauges.value_or(0)});
    has_gauges = has_gauges || state.gauges.has_value();
    x.push_back(static_cast<double>(x.size()));
    y.push_back(state.at_gauges.value);
  }
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  Plot plot(context.flow, box,
            {translate("State, 0 is the reference"), -0.5, x.back() + 0.5, true, false},
            {translate("Axial strain / µε"), low, high});
  const Look& look = context.flow.look();
  const double size_pt = plot.MarkerSize_pt();
  plot.DrawCurve(x, y, {look.measured, 0.25 + 0.25 * size_pt});
  for (std::size_t i = 0; i < states.size(); ++i) {
    plot.DrawErrorBar(x[i], y[i], states[i].at_gauges.expanded_uncertainty, look.measured, size_pt);
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

Status DrawStrainGauges(const ReportContext& context, const PageBox& box) {
  std::vector<State> states = States(context);
  std::erase_if(states, [](const State& state) { return !state.gauges; });
  if (states.empty()) {
    DrawNoData(context, box);
    return {};
  }
  double low = 0, high = 0;
  for (const State& state : states) {
    low = std::min({low, state.at_gauges.value, *state.gauges});
    high = std::max({high, state.at_gauges.value, *state.gauges});
  }
  const double margin = 0.06 * (high - low);
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  Plot plot(context.flow, box,
            {translate("Gauges, change / µε"), low - margin, high + margin, false, false},
            {translate("Camera at the gauges / µε"), low - margin, high + margin, false, false});
  const Look& look = context.flow.look();
  plot.DrawCurve({plot.x_low(), plot.x_high()}, {plot.x_low(), plot.x_high()},
                 {look.reference, 0.9});
  for (const State& state : states) {
    plot.DrawErrorBar(*state.gauges, state.at_gauges.value, state.at_gauges.expanded_uncertainty,
                      look.measured);
    plot.DrawMarker(*state.gauges, state.at_gauges.value, Marker::kDot, look.measured, 2);
  }
  plot.DrawLegend({{translate("states"), Marker::kDot, look.measured},
                   {"1 : 1", Marker::kDot, look.reference, true}});
  return {};
}

// Camera minus gauges of every state; the limit is one of the RMS over them.
Status DrawStrainErrors(const ReportContext& context, const PageBox& box) {
  const std::vector<State> states = States(context);
  const Json& limit_row = FindBy(ListAt(context.results, "/quantities"), "id", "strain_error");
  const auto limit = NumberAt(limit_row, "/limit");
  double reach = 1.15 * limit.value_or(0);
  bool has_gauges = false;
  for (const State& state : states) {
    if (!state.gauges) continue;
    has_gauges = true;
    const double error = std::abs(state.at_gauges.value - *state.gauges);
    reach = std::max(reach, 1.05 * (error + state.at_gauges.expanded_uncertainty));
  }
  if (!has_gauges) {
    DrawNoData(context, box);
    return {};
  }
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  const double last = static_cast<double>(states.size()) - 0.5;
  Plot plot(context.flow, box, {translate("State, 0 is the reference"), -0.5, last, true, false},
            {translate("Camera - gauges / µε"), -reach, reach});
  const Look& look = context.flow.look();
  const double size_pt = plot.MarkerSize_pt();
  plot.DrawCurve({plot.x_low(), plot.x_high()}, {0, 0}, {look.muted, 0.7});
  if (limit) {
    plot.DrawLimit(*limit, translate("limit of the RMS error") + " " +
                               TextAt(limit_row, "/printed_limit") + " µε");
    plot.DrawLimit(-*limit, "");
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!states[i].gauges) continue;
    const double x = static_cast<double>(i), error = states[i].at_gauges.value - *states[i].gauges;
    plot.DrawErrorBar(x, error, states[i].at_gauges.expanded_uncertainty, look.measured, size_pt);
    plot.DrawMarker(x, error, Marker::kDot, look.measured, size_pt);
  }
  plot.DrawLegend({{translate("error ± U of the camera"), Marker::kDot, look.measured}});
  return {};
}

}  // namespace

void DrawNoData(const ReportContext& context, const PageBox& box) {
  const Look& look = context.flow.look();
  context.flow.pdf().StrokeBox(box, {look.line, 0.6});
  context.flow.pdf().DrawText(look.Note(),
                              {box.left_pt + box.width_pt / 2, box.bottom_pt + box.height_pt / 2},
                              context.layout.Say("not measured"), Align::kCenter);
}

namespace {

using Draw = Status (*)(const ReportContext&, const PageBox&);

const std::map<std::string, Draw>& Charts() {
  static const std::map<std::string, Draw> kDraw = {
      {"residual-field", DrawResidualField},
      {"residual-histogram", DrawResidualHistogram},
      {"residual-scatter", DrawResidualScatter},
      {"ruler-errors", DrawRulerErrors},
      {"strain-states", DrawStrainStates},
      {"strain-gauges", DrawStrainGauges},
      {"strain-errors", DrawStrainErrors},
      {"ruler-positions", DrawRulerPositions},
      {"ruler-depths", DrawRulerDepths},
      {"strain-hysteresis", DrawStrainHysteresis},
      {"diagnosis-histogram", DrawDiagnosisHistogram},
      {"diagnosis-lengths", DrawDiagnosisLengths},
      {"diagnosis-directions", DrawDiagnosisDirections},
      {"regional-means", DrawRegionalMeans},
      {"regional-deviations", DrawRegionalDeviations},
      {"uncertainty-of-noise", DrawProjectionUncertainty},
      {"uncertainty-of-everything", DrawProjectionUncertaintyOfEverything},
      {"pinhole-rms", DrawPinholeRms},
      {"pinhole-ruler", DrawPinholeRuler}};
  return kDraw;
}

}  // namespace

std::vector<std::string> ChartNames() {
  std::vector<std::string> names;
  for (const auto& [name, draw] : Charts()) names.push_back(name);
  return names;
}

Status DrawChart(const ReportContext& context, const std::string& name, const PageBox& box) {
  return Charts().at(name)(context, box);
}

}  // namespace telestrain
