#include "base/csv.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <string_view>

#include "base/files.h"
#include "base/utf8.h"

namespace telestrain {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string Trim(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Splits one line; a doubled quote inside a quoted cell stands for one. Nothing if a quote is open
// or a cell has text beside its quotes.
std::optional<std::vector<std::string>> SplitLine(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  bool was_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back().push_back(line[++i]);
    } else if (quoted && c == '"') {
      quoted = false;
    } else if (quoted) {
      cells.back().push_back(c);
    } else if (c == '"') {
      if (was_quoted || !Trim(cells.back()).empty()) return {};
      cells.back().clear();
      quoted = was_quoted = true;
    } else if (c == ',') {
      if (!was_quoted) cells.back() = Trim(cells.back());
      cells.emplace_back();
      was_quoted = false;
    } else if (!was_quoted) {
      cells.back().push_back(c);
    } else if (!Trim(std::string(1, c)).empty()) {
      return {};
    }
  }
  if (quoted) return {};
  if (!was_quoted) cells.back() = Trim(cells.back());
  return cells;
}

// The column of the first cell that is not UTF-8, by its header or its number. There is one: cells
// are parted at ASCII bytes, which end every faulty sequence.
std::string FaultyPart(const CsvTable& table, const std::vector<std::string>& cells) {
  const auto is_faulty = [](const std::string& cell) { return !IsValidUtf8(cell); };
  const auto at = std::find_if(cells.begin(), cells.end(), is_faulty);
  const auto index = static_cast<std::size_t>(at - cells.begin());
  if (index < table.columns.size()) return "column '" + table.columns[index] + "'";
  return "column " + std::to_string(index + 1);
}

// `line` as it stands in the file, comments too: one text editor wrote all of it.
Status CheckEncoding(const CsvTable& table, int number, const std::string& line) {
  if (IsValidUtf8(line)) return {};
  const auto cells = SplitLine(line);
  const bool is_comment = Trim(line).starts_with('#');
  const std::string part = cells && !is_comment ? FaultyPart(table, *cells) : "the line";
  return BadInput(table.name + ":" + std::to_string(number) + ": " + part +
                  " holds bytes that are not UTF-8; save the file as UTF-8");
}

// Texts of tables go into results, file names and the report.
Status CheckControls(const CsvTable& table, int number, const std::string& line) {
  const auto is_control = [](char c) {
    return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r') || c == 0x7F;
  };
  const auto at = std::find_if(line.begin(), line.end(), is_control);
  if (at == line.end()) return {};
  return BadInput(table.name + ":" + std::to_string(number) + ": byte " +
                  std::to_string(at - line.begin() + 1) + " of the line is the control character " +
                  PrintableText(std::string(1, *at)) + "; remove it, or save the file as UTF-8");
}

Status CheckSize(const CsvTable& table, int number, std::size_t cells) {
  const std::string where = table.name + ":" + std::to_string(number) + ": ";
  if (table.columns.size() > kMostColumns)
    return BadInput(where + "the header has " + std::to_string(table.columns.size()) +
                    " columns, the limit is " + std::to_string(kMostColumns) +
                    "; remove those that are not needed");
  if (cells > kMostCells)
    return BadInput(where + "the table has more than " + std::to_string(kMostCells) +
                    " cells, the limit; split it");
  return {};
}

Status CheckHeader(const CsvTable& table, int line) {
  std::set<std::string> seen;
  for (const std::string& column : table.columns) {
    const std::string where = table.name + ":" + std::to_string(line) + ": ";
    if (column.empty()) return BadInput(where + "a column has no name; name every column");
    if (!seen.insert(column).second)
      return BadInput(where + "column '" + column + "' appears twice; remove one");
  }
  return {};
}

// Whether a cell would read back changed without quotes.
bool NeedsQuotes(const std::string& cell, bool is_alone) {
  return cell.find_first_of(",\"\n#") != std::string::npos || Trim(cell) != cell ||
         cell.starts_with(kByteOrderMark) || (is_alone && cell.empty());
}

}  // namespace

int CsvTable::Find(const std::string& column) const {
  const auto at = std::find(columns.begin(), columns.end(), column);
  return at == columns.end() ? -1 : static_cast<int>(at - columns.begin());
}

Result<CsvTable> ParseCsv(const std::string& name, const std::string& text) {
  CsvTable table;
  table.name = name;
  const bool is_marked = text.starts_with(kByteOrderMark);
  std::istringstream lines(is_marked ? text.substr(kByteOrderMark.size()) : text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    TELESTRAIN_RETURN_IF_ERROR(CheckEncoding(table, number, line));
    TELESTRAIN_RETURN_IF_ERROR(CheckControls(table, number, line));
    const std::string trimmed = Trim(line);
    if (trimmed.empty() || trimmed.front() == '#') continue;
    const std::string where = name + ":" + std::to_string(number) + ": ";
    auto cells = SplitLine(line);
    if (!cells)
      return BadInput(where +
                      "a cell with a double quote is not closed on this line or has text "
                      "beside the quotes; write \"…\" around the whole cell");
    if (table.columns.empty()) {
      table.columns = std::move(*cells);
      table.header_line = number;
      TELESTRAIN_RETURN_IF_ERROR(CheckSize(table, number, 0));
      TELESTRAIN_RETURN_IF_ERROR(CheckHeader(table, number));
    } else if (cells->size() != table.columns.size()) {
      return BadInput(where + std::to_string(cells->size()) + " cells, the header has " +
                      std::to_string(table.columns.size()) + "; make them equal");
    } else {
      table.rows.push_back({number, std::move(*cells)});
      TELESTRAIN_RETURN_IF_ERROR(
          CheckSize(table, number, table.rows.size() * table.columns.size()));
    }
  }
  if (table.columns.empty()) return BadInput(name + ": is empty; it needs a header line");
  return table;
}

Result<CsvTable> ReadCsv(const std::filesystem::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMostResultBytes));
  return ParseCsv(path.filename().string(), text);
}

std::string CsvLine(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    if (!NeedsQuotes(cells[i], cells.size() == 1)) {
      line += cells[i];
      continue;
    }
    line += '"';
    for (const char c : cells[i]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + '\n';
}

}  // namespace telestrain
