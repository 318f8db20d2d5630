#pragma once

#include <string>
#include <vector>

#include "report/report_blocks.h"

namespace telestrain {

// Draws the chart `name` of a layout into `box`; a chart without data says so in its place. Fails
// (kBadInput) when residuals.csv is malformed.
Status DrawChart(const ReportContext& context, const std::string& name, const PageBox& box);
// What DrawChart can draw.
std::vector<std::string> ChartNames();

// The three charts of the calibration's residuals, from calibration.json and residuals.csv.
Status DrawResidualField(const ReportContext& context, const PageBox& box);
Status DrawResidualHistogram(const ReportContext& context, const PageBox& box);
Status DrawResidualScatter(const ReportContext& context, const PageBox& box);

// The charts of the diagnosis. From mrcal.json: all residuals against their Gaussian on logarithmic
// counts, directions as a rose of sectors, means and standard deviations over the field of each
// view. From residuals.csv and mrcal.json: lengths against the Rayleigh curve.
Status DrawDiagnosisHistogram(const ReportContext& context, const PageBox& box);
Status DrawDiagnosisLengths(const ReportContext& context, const PageBox& box);
Status DrawDiagnosisDirections(const ReportContext& context, const PageBox& box);
Status DrawRegionalMeans(const ReportContext& context, const PageBox& box);
Status DrawRegionalDeviations(const ReportContext& context, const PageBox& box);
// How well each view knows where it projects: by the noise of its calibration, and by everything.
Status DrawProjectionUncertainty(const ReportContext& context, const PageBox& box);
Status DrawProjectionUncertaintyOfEverything(const ReportContext& context, const PageBox& box);
// From the table "pinhole" of results.json: against the working distance, both axes logarithmic.
Status DrawPinholeRms(const ReportContext& context, const PageBox& box);
Status DrawPinholeRuler(const ReportContext& context, const PageBox& box);

// Length errors of all ruler images, over the ruler's position along the pipe and over its depth,
// each with its U and the limits; from the table "ruler".
Status DrawRulerErrors(const ReportContext& context, const PageBox& box);
Status DrawRulerPositions(const ReportContext& context, const PageBox& box);
Status DrawRulerDepths(const ReportContext& context, const PageBox& box);

// From the table "strain-states": strain of every state, camera over gauges with the line 1 : 1 and
// the regression, camera minus gauges over the states and over the gauges with the unloading states
// apart.
Status DrawStrainStates(const ReportContext& context, const PageBox& box);
Status DrawStrainGauges(const ReportContext& context, const PageBox& box);
Status DrawStrainErrors(const ReportContext& context, const PageBox& box);
Status DrawStrainHysteresis(const ReportContext& context, const PageBox& box);

// The components of every uncertainty budget as bars, from the table "budget".
Status DrawBudgetBars(const ReportContext& context, const PageBox& box);

// "no data" in the middle of an empty frame.
void DrawNoData(const ReportContext& context, const PageBox& box);

}  // namespace telestrain
