#include "report/report_charts.h"

#include <map>

namespace telestrain {

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
      {"budget-bars", DrawBudgetBars},
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
