#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/json_lookup.h"
#include "report/page_flow.h"

namespace telestrain {

// A table of at most this share of a page is not broken over pages.
constexpr double kWholeShare = 0.35;

struct TableStyle {
  double width_mm = 0;            // 0: the whole width
  std::vector<std::string> mono;  // names of the columns set in the monospaced face
  bool show_title = true;
  std::string continued = "continued";
  std::function<std::string(const std::string&)> translate;  // of column names; may be empty
};

// Draws a table of results.json. "row_links": [destination or {"link": destination} or null, …] of
// the table makes the first cell of such a row a link. Columns get the width their content needs;
// text columns wrap when that is too much, then the type shrinks (to 6 pt), then words are cut:
// nothing is ever clipped or overlaps. Breaks over pages between rows and repeats the header there.
void DrawTable(PageFlow& flow, const Json& table, const TableStyle& style);

// Draws a table of (name, value, unit) rows as lines "name   value unit", in one or two columns
// side by side of `width_pt` in all.
void DrawFacts(PageFlow& flow, const Json& table, int columns, double width_pt);
double FactsHeight_pt(PageFlow& flow, const Json& table, int columns, double width_pt);

// What the PDF prints for a cell.
std::string CellText(const Json& cell);

}  // namespace telestrain
