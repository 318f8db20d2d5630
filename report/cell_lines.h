#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/page_flow.h"

namespace telestrain {

// A wrapped text in a row of texts that stand side by side.
struct CellLines {
  TextStyle style;
  double left_pt = 0;
  double width_pt = 0;
  Align align = Align::kLeft;
  std::vector<std::string> lines;
  int tag = 0;        // of PdfDocument::BeginTag: what the lines are a piece of; 0: the open tag
  std::string link;   // the destination that the lines lead to, or empty
  std::string leads;  // in words, for a reading aid
};

CellLines MakeCellLines(PdfDocument& pdf, const TextStyle& style, double left_pt, double width_pt,
                        const std::string& text, Align align = Align::kLeft);

// How a row of cells is drawn and broken over pages.
struct RowFrame {
  double line_height_pt = 12;
  double gap_pt = 2;                                    // between this row and the next
  std::function<void(const PageBox&)> draw_background;  // may be empty
  std::function<void()> start_new_page;  // finishes this page and leaves the next one ready
};

double RowHeight_pt(const std::vector<CellLines>& cells, const RowFrame& frame);

// Draws the row; one that does not fit starts on a new page, one that is higher than a page is cut
// between its lines.
void DrawRow(PageFlow& flow, const std::vector<CellLines>& cells, const RowFrame& frame);

}  // namespace telestrain
