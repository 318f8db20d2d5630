#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

constexpr std::size_t kMostColumns = 256;
// residuals.csv of 5000 images has 26 million; each takes 32 bytes or more.
constexpr std::size_t kMostCells = 30'000'000;

// A comma-separated table with a header row. Cells are trimmed; double quotes protect commas.
// Empty lines and lines that begin with '#' are skipped.
struct CsvTable {
  std::string name;                  // as it appears in errors
  int header_line = 1;               // 1-based line of the header in the file
  std::vector<std::string> columns;  // header cells
  struct Row {
    int line = 0;  // 1-based line in the file
    std::vector<std::string> cells;
  };
  std::vector<Row> rows;

  // Index of a column, or -1.
  int Find(const std::string& column) const;
};

// Parses `text`; `name` is used in errors. Fails (kBadInput) on text that is not UTF-8, a missing
// header, more than kMostColumns columns or kMostCells cells, a duplicate or empty column name, a
// control character, or a row whose number of cells differs from the header's.
Result<CsvTable> ParseCsv(const std::string& name, const std::string& text);
Result<CsvTable> ReadCsv(const std::filesystem::path& path);

// One line of a table, cells quoted where they need it, with the line end.
std::string CsvLine(const std::vector<std::string>& cells);

}  // namespace telestrain
