#include "report/cell_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "report/text_wrap.h"

namespace telestrain {
namespace {

constexpr double kAscent = 0.94;         // of the size: where the base line stands in its line
constexpr double kRepeatedHead_pt = 60;  // what a continued table draws again on a new page
constexpr std::size_t kFewestLines = 3;  // of a cut row at the foot of a page

std::size_t LineCount(const std::vector<CellLines>& cells) {
  std::size_t count = 1;
  for (const CellLines& cell : cells) count = std::max(count, cell.lines.size());
  return count;
}

// Makes the lines of this page the link's area.
void AddLinkOver(PageFlow& flow, const CellLines& cell, const RowFrame& frame, std::size_t lines) {
  const double height_pt = static_cast<double>(lines) * frame.line_height_pt;
  double width_pt = 0;
  for (const std::string& line : cell.lines)
    width_pt = std::max(width_pt, flow.pdf().TextWidth_pt(cell.style, line));
  const double free_pt = std::max(0.0, cell.width_pt - width_pt);
  const double share = cell.align == Align::kLeft ? 0 : cell.align == Align::kCenter ? 0.5 : 1;
  flow.pdf().AddLink({cell.left_pt + share * free_pt, flow.y_pt() - frame.gap_pt / 2 - height_pt,
                      cell.width_pt - free_pt, height_pt},
                     cell.link);
}

void DrawLines(PageFlow& flow, const CellLines& cell, const RowFrame& frame, std::size_t from,
               std::size_t count) {
  const std::size_t end = std::min(from + count, cell.lines.size());
  if (from >= end) return;
  std::optional<ScopedTag> piece, link;
  if (cell.tag != 0) piece.emplace(flow.pdf(), cell.tag);
  if (!cell.link.empty()) {
    link.emplace(flow.pdf(), PdfTag{"Link", cell.leads});
    AddLinkOver(flow, cell, frame, end - from);
  }
  const double share = cell.align == Align::kLeft ? 0 : cell.align == Align::kCenter ? 0.5 : 1;
  double y_pt = flow.y_pt() - frame.gap_pt / 2;
  for (std::size_t i = from; i < end; ++i) {
    flow.pdf().DrawText(cell.style,
                        {cell.left_pt + share * cell.width_pt, y_pt - kAscent * cell.style.size_pt},
                        cell.lines[i], cell.align);
    y_pt -= frame.line_height_pt;
  }
}

// How many of `left` lines go on this page; 0: start a new one.
std::size_t LinesThatFit(const PageFlow& flow, const RowFrame& frame, std::size_t left) {
  const auto lines_in = [&](double height_pt) {
    const double lines = std::floor((height_pt - frame.gap_pt) / frame.line_height_pt + 1e-9);
    return static_cast<std::size_t>(std::max(0.0, lines));
  };
  const std::size_t here = lines_in(flow.Free_pt());
  if (left <= here) return left;
  const bool fits_on_one_page = left <= lines_in(flow.PageBody_pt() - kRepeatedHead_pt);
  return fits_on_one_page || here < kFewestLines ? 0 : here;
}

}  // namespace

CellLines MakeCellLines(PdfDocument& pdf, const TextStyle& style, double left_pt, double width_pt,
                        const std::string& text, Align align) {
  return {style, left_pt, width_pt, align, WrapText(pdf, style, text, width_pt), 0, {}, {}};
}

double RowHeight_pt(const std::vector<CellLines>& cells, const RowFrame& frame) {
  return static_cast<double>(LineCount(cells)) * frame.line_height_pt + frame.gap_pt;
}

void DrawRow(PageFlow& flow, const std::vector<CellLines>& cells, const RowFrame& frame) {
  const std::size_t total = LineCount(cells);
  for (std::size_t from = 0; from < total;) {
    const std::size_t count = LinesThatFit(flow, frame, total - from);
    if (count == 0) {
      frame.start_new_page();
      continue;
    }
    const double height_pt = static_cast<double>(count) * frame.line_height_pt + frame.gap_pt;
    if (frame.draw_background)
      frame.draw_background({flow.left_pt(), flow.y_pt() - height_pt, flow.width_pt(), height_pt});
    for (const CellLines& cell : cells) DrawLines(flow, cell, frame, from, count);
    flow.Advance(height_pt);
    from += count;
  }
}

}  // namespace telestrain
