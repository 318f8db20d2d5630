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
  return CellText(EntryAt(row, "/1")) + (unit.empty() || unit == "°" ? "" : " ") + unit;
}

struct FactRows {
  RowFrame frame;
  std::vector<std::vector<CellLines>> rows;
};

// `tags`: a pair for every fact, or none when the rows are only measured.
FactRows MakeFactRows(PageFlow& flow, const Json& table, int columns, double width_pt,
                      const std::vector<FactTags>& tags) {
  const TextStyle name_style{Face::kRegular, flow.look().Scaled_pt(8.5), flow.look().muted};
  const TextStyle value_style{Face::kRegular, flow.look().Scaled_pt(9), flow.look().ink};
  const Json& facts = ListAt(table, "/rows");
  const double gap_pt = 14, column_pt = (width_pt - gap_pt * (columns - 1)) / columns;
  double name_pt = 0;
  for (const Json& fact : facts)
    name_pt =
        std::max(name_pt, flow.pdf().TextWidth_pt(name_style, CellText(EntryAt(fact, "/0"))) + 10);
  name_pt = std::clamp(name_pt, 60.0, 0.62 * column_pt);
  FactRows made;
  made.frame.line_height_pt = value_style.LineHeight_pt();
  made.frame.start_new_page = [&flow] { flow.StartPage(); };
  const std::size_t lines = (facts.size() + columns - 1) / columns;
  for (std::size_t line = 0; line < lines; ++line) {
    std::vector<CellLines> cells;
    double x_pt = flow.left_pt();
    for (std::size_t i = line; i < facts.size(); i += lines, x_pt += column_pt + gap_pt) {
      cells.push_back(MakeCellLines(flow.pdf(), name_style, x_pt, name_pt - 6,
                                    CellText(EntryAt(facts[i], "/0"))));
      cells.push_back(MakeCellLines(flow.pdf(), value_style, x_pt + name_pt, column_pt - name_pt,
                                    FactText(facts[i])));
      if (tags.empty()) continue;
      (cells.end() - 2)->tag = tags[i].name;
      cells.back().tag = tags[i].value;
    }
    made.rows.push_back(std::move(cells));
  }
  return made;
}

}  // namespace

double FactsHeight_pt(PageFlow& flow, const Json& table, int columns, double width_pt) {
  const FactRows facts = MakeFactRows(flow, table, columns, width_pt, {});
  double height_pt = 0;
  for (const auto& row : facts.rows) height_pt += RowHeight_pt(row, facts.frame);
  return height_pt;
}

void DrawFacts(PageFlow& flow, const Json& table, int columns, double width_pt) {
  const ScopedTag tag(flow.pdf(), PdfTag{"Table"});
  const std::vector<FactTags> tags = TagFacts(flow.pdf(), ListAt(table, "/rows").size());
  const FactRows facts = MakeFactRows(flow, table, columns, width_pt, tags);
  for (const auto& row : facts.rows) DrawRow(flow, row, facts.frame);
  flow.Advance(6);
}

}  // namespace telestrain
