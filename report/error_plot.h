#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/plot.h"
#include "report/report_blocks.h"

namespace telestrain {

// Errors with their uncertainties over a coordinate, about a zero line.

struct ErrorPoint {
  double x = 0, error = 0, expanded_uncertainty = 0;
  Marker marker = Marker::kDot;
  Color color;
};

struct ErrorChart {
  std::string x_label, y_label;
  std::vector<Plot::LegendEntry> legend;
  bool numbered = false;        // x counts: one unit apart, whole numbers
  std::optional<double> limit;  // of |error|
  std::string limit_text;       // "MPE ± 3 µm"
};

// How far the axis of errors reaches. The errors set it, so that small ones are not flat beside a
// wide limit; the limit is inside only where that leaves the errors a fifth of the height.
struct ErrorRange {
  double reach = 1;
  bool limit_is_inside = false;
};
ErrorRange RangeOfErrors(const std::vector<ErrorPoint>& points, std::optional<double> limit);

// Draws it; a limit that is not inside is named in a corner. Without points it says "not measured".
Status DrawErrorChart(const ReportContext& context, const PageBox& box,
                      const std::vector<ErrorPoint>& points, const ErrorChart& chart);

}  // namespace telestrain
