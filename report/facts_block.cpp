#include <algorithm>

#include "report/cell_lines.h"
#include "report/table_block.h"

namespace telestrain {
namespace {

// The places of name and value in the tags: read fact by fact, in whatever columns they stand.
struct FactTags {
  int name = 0, value = 0;
};

std::vector<FactTags> TagFacts(PdfDocument& pdf, std::size_t count) {
  std::vector<FactTags> tags;
  for (std::size_t i = 0; i < count; ++i) {
    const ScopedTag row(pdf, PdfTag{"TR"});
    FactTags fact;
    fact.name = ScopedTag(pdf, PdfTag{"TH", "", "Row"}).number();
    fact.value = ScopedTag(pdf, PdfTag{"TD"}).number();
    tags.push_back(fact);
  }
  return tags;
}

std::string FactText(const Json& row) {
  const std::string unit = TextAt(row, "/2");
  return CellText(row[1]) + (unit.empty() || unit == "°" ? "" : " ") + unit;
}

}  // namespace

void DrawFacts(PageFlow& flow, const Json& table, int columns, double width_pt,
               const std::function<std::string(const std::string&)>& translate) {
  const TextStyle name_style{Face::kRegular, flow.look().Scaled_pt(8.5), flow.look().muted};
  const TextStyle value_style{Face::kRegular, flow.look().Scaled_pt(9), flow.look().ink};
  const Json& rows = ListAt(table, "/rows");
  const double gap_pt = 14, column_pt = (width_pt - gap_pt * (columns - 1)) / columns;
  const auto name_of = [&](const Json& row) { return translate(CellText(row[0])); };
  double name_pt = 0;
  for (const Json& row : rows)
    name_pt = std::max(name_pt, flow.pdf().TextWidth_pt(name_style, name_of(row)) + 10);
  name_pt = std::clamp(name_pt, 60.0, 0.62 * column_pt);
  RowFrame frame;
  frame.line_height_pt = value_style.LineHeight_pt();
  frame.start_new_page = [&] { flow.StartPage(); };
  const ScopedTag facts(flow.pdf(), PdfTag{"Table"});
  const std::vector<FactTags> tags = TagFacts(flow.pdf(), rows.size());
  const std::size_t lines = (rows.size() + columns - 1) / columns;
  for (std::size_t line = 0; line < lines; ++line) {
    std::vector<CellLines> cells;
    double x_pt = flow.left_pt();
    for (std::size_t i = line; i < rows.size(); i += lines, x_pt += column_pt + gap_pt) {
      cells.push_back(MakeCellLines(flow.pdf(), name_style, x_pt, name_pt - 6, name_of(rows[i])));
      cells.push_back(MakeCellLines(flow.pdf(), value_style, x_pt + name_pt, column_pt - name_pt,
                                    FactText(rows[i])));
      (cells.end() - 2)->tag = tags[i].name;
      cells.back().tag = tags[i].value;
    }
    DrawRow(flow, cells, frame);
  }
  flow.Advance(6);
}

}  // namespace telestrain
