#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/color_map.h"
#include "report/report_blocks.h"

namespace telestrain {

// Values over the field of one view, at the points of a grid whose outer ones lie on the edges of
// the field; row by row, the first row at the top of the image. Nothing: no data, left blank.
struct FieldMap {
  std::string title;
  int columns = 0, rows = 0;
  double step_x_px = 1, step_y_px = 1;
  std::vector<std::optional<double>> values;  // columns × rows
};

// The maps side by side at one scale, as large as the box allows, with one colour bar for all.
// `scale` is the range of the colours; values outside take the colours of its ends.
void DrawFieldMaps(const ReportContext& context, const PageBox& box,
                   const std::vector<FieldMap>& maps, const PlotAxis& scale);

}  // namespace telestrain
