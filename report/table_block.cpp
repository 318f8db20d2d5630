#include "report/table_block.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "report/cell_lines.h"
#include "report/text_wrap.h"

namespace telestrain {
namespace {

constexpr double kPadding_pt = 4;
constexpr double kRowGap_pt = 4.2;
constexpr double kLargestType_pt = 8.5, kSmallestType_pt = 6, kTypeStep_pt = 0.25;
constexpr double kUnbroken_pt = 42;  // a shorter text stays on one line: "≤ 0.05"
constexpr double kMonoShare = 0.9;   // the monospaced face looks larger than the text

struct Column {
  std::string name, unit;
  Align align = Align::kLeft;
  bool mono = false;
  double indent_pt = kPadding_pt;  // wider where a text follows a number
  double width_pt = 0, natural_pt = 0, least_pt = 0;
};

class TableDrawing {
 public:
  TableDrawing(PageFlow& flow, const Json& table, const TableStyle& style)
      : flow_(flow), pdf_(flow.pdf()), table_(table), style_(style) {
    type_pt_ = flow.look().Scaled_pt(kLargestType_pt);
    width_pt_ = style.width_mm > 0 ? style.width_mm * kPointsPerMm : flow.width_pt();
    ReadColumns();
    ChooseWidths();
  }
  void Draw();

 private:
  void ReadColumns();
  void Measure();
  void ChooseWidths();
  void FitToWidth();
  TextStyle CellStyle(const Column& column, const Json& cell) const;
  TextStyle HeaderStyle() const { return {Face::kBold, type_pt_, ColorOf(0xFFFFFF)}; }
  TextStyle UnitStyle() const { return {Face::kRegular, type_pt_, ColorOf(0xD5DFE9)}; }
  double InnerWidth_pt(const Column& column) const {
    return column.width_pt - column.indent_pt - kPadding_pt;
  }
  double HeaderHeight_pt();
  std::vector<CellLines> RowCells(const Json& row);
  void TagRow(std::size_t row, std::vector<CellLines>& cells);
  RowFrame FrameOfRows();
  void DrawHeader(bool continued);
  void DrawTitle(bool continued);
  void DrawBottomRule();

  PageFlow& flow_;
  PdfDocument& pdf_;
  const Json& table_;
  const TableStyle& style_;
  std::vector<Column> columns_;
  double type_pt_ = 0;
  double width_pt_ = 0;
  int rows_on_page_ = 0;
};

void TableDrawing::ReadColumns() {
  const auto& mono = style_.mono;
  for (const Json& json : ListAt(table_, "/columns")) {
    Column column;
    const std::string name = TextAt(json, "/name");
    column.name = style_.translate ? style_.translate(name) : name;
    column.unit = TextAt(json, "/unit");
    column.mono = std::find(mono.begin(), mono.end(), name) != mono.end();
    const std::string index = std::to_string(columns_.size());
    for (const Json& row : ListAt(table_, "/rows")) {
      const Json& cell = EntryAt(row, "/" + index);
      if (cell.is_object() && cell.contains("value")) column.align = Align::kRight;
      if (cell.is_object() && cell.contains("verdict")) column.align = Align::kCenter;
    }
    const bool behind_number = !columns_.empty() && columns_.back().align == Align::kRight;
    if (behind_number && column.align == Align::kLeft) column.indent_pt = 3 * kPadding_pt;
    columns_.push_back(column);
  }
}

TextStyle TableDrawing::CellStyle(const Column& column, const Json& cell) const {
  TextStyle style{column.mono ? Face::kMono : Face::kRegular, type_pt_, flow_.look().ink};
  if (column.mono) style.size_pt *= kMonoShare;
  if (cell.is_object() && cell.contains("verdict")) {
    style.face = Face::kBold;
    style.color = flow_.look().OfVerdict(TextAt(cell, "/verdict"));
  }
  return style;
}

// Natural width: all on one line. Least width: no word or number cut.
void TableDrawing::Measure() {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Column& column = columns_[i];
    column.natural_pt = std::max(pdf_.TextWidth_pt(HeaderStyle(), column.name),
                                 pdf_.TextWidth_pt(UnitStyle(), column.unit));
    column.least_pt = std::max(WidestWord_pt(pdf_, HeaderStyle(), column.name),
                               WidestWord_pt(pdf_, UnitStyle(), column.unit));
    for (const Json& row : ListAt(table_, "/rows")) {
      const Json& cell = row[i];
      const TextStyle style = CellStyle(column, cell);
      const double text_pt = pdf_.TextWidth_pt(style, CellText(cell));
      const bool is_text = cell.is_string() || (cell.is_object() && cell.contains("pattern"));
      const bool breakable = is_text && !column.mono && text_pt > kUnbroken_pt;
      column.natural_pt = std::max(column.natural_pt, text_pt);
      column.least_pt = std::max(column.least_pt,
                                 breakable ? WidestWord_pt(pdf_, style, CellText(cell)) : text_pt);
    }
    column.natural_pt += column.indent_pt + kPadding_pt;
    column.least_pt += column.indent_pt + kPadding_pt;
  }
}

void TableDrawing::FitToWidth() {
  // A long text would leave the other columns one word a line: it asks for this share at most.
  constexpr double kLongestShare = 0.5;
  double natural_pt = 0, least_pt = 0;
  for (const Column& column : columns_) natural_pt += column.natural_pt;
  if (natural_pt > width_pt_) {
    natural_pt = 0;
    for (Column& column : columns_) {
      const double longest_pt = std::max(column.least_pt, kLongestShare * width_pt_);
      column.natural_pt = std::min(column.natural_pt, longest_pt);
      natural_pt += column.natural_pt;
    }
  }
  for (const Column& column : columns_) least_pt += column.least_pt;
  for (Column& column : columns_) {
    if (natural_pt <= width_pt_) {
      column.width_pt = column.natural_pt * width_pt_ / natural_pt;
    } else if (least_pt <= width_pt_) {
      const double share = (width_pt_ - least_pt) / (natural_pt - least_pt);
      column.width_pt = column.least_pt + share * (column.natural_pt - column.least_pt);
    } else {
      column.width_pt = column.least_pt * width_pt_ / least_pt;  // words are cut
    }
  }
}

void TableDrawing::ChooseWidths() {
  const auto least_pt = [this] {
    Measure();
    return std::accumulate(columns_.begin(), columns_.end(), 0.0,
                           [](double sum, const Column& c) { return sum + c.least_pt; });
  };
  while (least_pt() > width_pt_ && type_pt_ > kSmallestType_pt) type_pt_ -= kTypeStep_pt;
  FitToWidth();
}

double TableDrawing::HeaderHeight_pt() {
  double height_pt = 0;
  for (const Column& column : columns_) {
    double lines_pt = flow_.TextHeight_pt(HeaderStyle(), InnerWidth_pt(column), column.name);
    if (!column.unit.empty())
      lines_pt += flow_.TextHeight_pt(UnitStyle(), InnerWidth_pt(column), column.unit);
    height_pt = std::max(height_pt, lines_pt);
  }
  return height_pt + kRowGap_pt + 1;
}

std::vector<CellLines> TableDrawing::RowCells(const Json& row) {
  std::vector<CellLines> cells;
  double x_pt = flow_.left_pt();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    cells.push_back(MakeCellLines(pdf_, CellStyle(column, row[i]), x_pt + column.indent_pt,
                                  InnerWidth_pt(column), CellText(row[i]), column.align));
    x_pt += column.width_pt;
  }
  return cells;
}

// Every row has a cell for every column, empty or not; the first names the row.
void TableDrawing::TagRow(std::size_t row, std::vector<CellLines>& cells) {
  const ScopedTag row_tag(pdf_, PdfTag{"TR"});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool names_row = i == 0 && cells.size() > 1 && !cells[i].lines.front().empty();
    const PdfTag tag = names_row ? PdfTag{"TH", "", "Row"} : PdfTag{"TD"};
    cells[i].tag = ScopedTag(pdf_, tag).number();
  }
  const Json& links = ListAt(table_, "/row_links");
  if (row >= links.size() || cells.empty()) return;
  cells[0].link =
      links[row].is_string() ? links[row].get<std::string>() : TextAt(links[row], "/link");
  for (const std::string& line : cells[0].lines) cells[0].leads += line;
}

RowFrame TableDrawing::FrameOfRows() {
  RowFrame frame;
  frame.line_height_pt = TextStyle{Face::kRegular, type_pt_, {}}.LineHeight_pt();
  frame.gap_pt = kRowGap_pt;
  frame.draw_background = [this](PageBox box) {
    box.width_pt = width_pt_;
    if (rows_on_page_++ % 2 == 1) pdf_.FillBox(box, flow_.look().zebra);
  };
  frame.start_new_page = [this] {
    DrawBottomRule();
    flow_.StartPage();
    const ScopedDecoration repeated(pdf_);
    DrawTitle(true);
    DrawHeader(true);
    rows_on_page_ = 0;
  };
  return frame;
}

void TableDrawing::DrawTitle(bool continued) {
  if (!style_.show_title) return;
  const std::string title = TextAt(table_, "/title");
  const std::string text = style_.translate ? style_.translate(title) : title;
  std::optional<ScopedTag> caption;
  if (!continued) caption.emplace(pdf_, PdfTag{"Caption"});
  flow_.Paragraph(flow_.look().Strong(), continued ? text + " (" + style_.continued + ")" : text);
  flow_.Advance(3);
}

void TableDrawing::DrawHeader(bool continued) {
  std::optional<ScopedTag> row, cell;
  if (!continued) row.emplace(pdf_, PdfTag{"TR"});
  const double height_pt = HeaderHeight_pt();
  const double top_pt = flow_.y_pt();
  pdf_.FillBox({flow_.left_pt(), top_pt - height_pt, width_pt_, height_pt}, flow_.look().accent);
  double x_pt = flow_.left_pt();
  for (const Column& column : columns_) {
    cell.reset();
    if (!continued) cell.emplace(pdf_, PdfTag{"TH", "", "Column"});
    PagePoint at{x_pt + column.indent_pt, top_pt - kRowGap_pt / 2};
    at.y_pt -= flow_.TextBlock(HeaderStyle(), at, InnerWidth_pt(column), column.name, column.align);
    if (!column.unit.empty())
      flow_.TextBlock(UnitStyle(), at, InnerWidth_pt(column), column.unit, column.align);
    x_pt += column.width_pt;
  }
  cell.reset();
  row.reset();
  flow_.Advance(height_pt);
}

void TableDrawing::DrawBottomRule() {
  const PagePoint left{flow_.left_pt(), flow_.y_pt()};
  pdf_.DrawLine(left, {left.x_pt + width_pt_, left.y_pt}, {flow_.look().accent, 0.8});
}

void TableDrawing::Draw() {
  const Json& rows = ListAt(table_, "/rows");
  const RowFrame frame = FrameOfRows();
  // The header never stands alone at the foot of a page.
  double start_pt = HeaderHeight_pt() + (style_.show_title ? 16 : 0);
  double whole_pt = start_pt;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double row_pt = RowHeight_pt(RowCells(rows[i]), frame);
    whole_pt += row_pt;
    if (i < 3) start_pt += row_pt;
  }
  const bool whole = whole_pt <= kWholeShare * flow_.PageBody_pt();
  flow_.Require(std::min(whole ? whole_pt : start_pt, flow_.PageBody_pt()));
  const ScopedTag tag(pdf_, PdfTag{"Table"});
  DrawTitle(false);
  DrawHeader(false);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<CellLines> cells = RowCells(rows[i]);
    TagRow(i, cells);
    DrawRow(flow_, cells, frame);
  }
  DrawBottomRule();
  flow_.Advance(10);
}

}  // namespace

std::string CellText(const Json& cell) {
  if (cell.is_object()) return TextAt(cell, "/printed");
  return cell.is_string() ? cell.get<std::string>() : cell.is_null() ? "" : cell.dump();
}

void DrawTable(PageFlow& flow, const Json& table, const TableStyle& style) {
  TableDrawing(flow, table, style).Draw();
}

}  // namespace telestrain
