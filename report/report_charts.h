#pragma once

#include <string>
#include <vector>

#include "report/report_blocks.h"

namespace telestrain {

// Draws the chart `name` of a layout into `box`; a chart without data says so in its place. Fails
// (kBadInput) when residuals.csv is malformed.
Status DrawChart(const ReportContext& context, const std::string& name, const PageBox& box);

// The three charts of the calibration's residuals, from calibration.json and residuals.csv.
Status DrawResidualField(const ReportContext& context, const PageBox& box);
Status DrawResidualHistogram(const ReportContext& context, const PageBox& box);
Status DrawResidualScatter(const ReportContext& context, const PageBox& box);

// "no data" in the middle of an empty frame.
void DrawNoData(const ReportContext& context, const PageBox& box);

}  // namespace telestrain
