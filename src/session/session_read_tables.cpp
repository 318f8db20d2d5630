#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <map>
#include <system_error>

#include "base/csv.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/utf8.h"
#include "session/inside_folder.h"
#include "session/pipe_table.h"
#include "session/session_parts.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestNumber = 1e9;

// Where every image was seen first, "folder/ruler.csv:3", over all tables; by its path without
// links, relative to the folder.
using SeenImages = std::map<std::string, std::string>;

// Reads cells of one table by column and row, with errors that say where they stand.
class TableReader {
 public:
  explicit TableReader(CsvTable table) : table_(std::move(table)) {}

  int size() const { return static_cast<int>(table_.rows.size()); }
  const CsvTable& table() const { return table_; }
  bool Has(const std::string& column) const { return table_.Find(column) >= 0; }

  std::string HeaderPlace() const { return table_.name + ":" + std::to_string(table_.header_line); }
  std::string Place(int row) const {
    return table_.name + ":" + std::to_string(table_.rows[static_cast<std::size_t>(row)].line);
  }
  const std::string& Cell(int row, const std::string& column) const {
    return table_.rows[static_cast<std::size_t>(row)]
        .cells[static_cast<std::size_t>(table_.Find(column))];
  }

  Result<std::string> Text(int row, const std::string& column) const {
    if (!Cell(row, column).empty()) return Cell(row, column);
    return BadInput(Place(row) + ": the cell '" + column + "' is empty; fill it in");
  }
  Result<double> Number(int row, const std::string& column) const {
    const auto number = ParseDouble(Cell(row, column));
    if (number && std::abs(*number) <= kLargestNumber) return *number;
    return BadInput(Place(row) + ": the cell '" + column + "' is '" + Cell(row, column) +
                    "', wanted a finite number with a decimal point, at most 1e9; correct it");
  }
  // An empty cell, or a column that is not there, is a missing value.
  Result<std::optional<double>> OptionalNumber(int row, const std::string& column) const {
    if (!Has(column) || Cell(row, column).empty()) return std::optional<double>{};
    TELESTRAIN_ASSIGN_OR_RETURN(const double number, Number(row, column));
    return std::optional<double>{number};
  }

 private:
  CsvTable table_;
};

bool IsGaugeColumn(const std::string& column) {
  constexpr std::string_view kBegin = "gauge_", kEnd = "_microstrain";
  return column.size() > kBegin.size() + kEnd.size() && column.starts_with(kBegin) &&
         column.ends_with(kEnd);
}

struct ColumnRules {
  std::vector<std::string> required;
  std::vector<std::string> optional;
  bool gauges = false;
};

std::string ListOf(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list.append(list.empty() ? "" : ", ").append(word);
  return list;
}

// Also true of a symbolic link to nowhere, which must not pass for a table that was left out.
bool IsThere(const fs::path& path) {
  std::error_code code;
  return fs::exists(fs::symlink_status(path, code));
}

Status CheckColumns(const CsvTable& table, const ColumnRules& rules) {
  std::vector<std::string> known = rules.required;
  known.insert(known.end(), rules.optional.begin(), rules.optional.end());
  if (rules.gauges) known.push_back("gauge_1_microstrain");
  const std::string place = table.name + ":" + std::to_string(table.header_line) + ": ";
  if (table.columns.size() == 1 && table.columns.front().find_first_of(";\t") != std::string::npos)
    return BadInput(place + "the columns are parted by '" +
                    (table.columns.front().find(';') != std::string::npos ? ";" : "tab") +
                    "'; write the table with ',' between them and '.' in numbers");
  for (const std::string& column : table.columns) {
    const bool is_known = std::find(known.begin(), known.end(), column) != known.end();
    if (is_known || (rules.gauges && IsGaugeColumn(column))) continue;
    return BadInput(place + "unknown column '" + column + "'; the nearest known column is '" +
                    NearestWord(column, known) + "': rename or remove it");
  }
  for (const std::string& column : rules.required)
    if (table.Find(column) < 0)
      return BadInput(place + "the column '" + column + "' is missing; add it to the header");
  return {};
}

Result<TableReader> OpenTable(const fs::path& path, const ColumnRules& rules) {
  if (!IsThere(path))
    return BadInput(path.string() + ": does not exist; make it with the columns " +
                    ListOf(rules.required));
  TELESTRAIN_RETURN_IF_ERROR(StaysInside(path));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMostTableBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(CsvTable table, ParseCsv(path.string(), text));
  TELESTRAIN_RETURN_IF_ERROR(CheckColumns(table, rules));
  if (table.rows.size() > kMostTableRows)
    return BadInput(path.string() + ": has " + std::to_string(table.rows.size()) +
                    " rows, the limit is " + std::to_string(kMostTableRows) +
                    "; divide it into several sessions");
  return TableReader(std::move(table));
}

Status CheckImageName(const std::string& place, const std::string& image) {
  const std::string forbidden = std::string(kCornerListSigns) + ",";
  if (image.find_first_of(forbidden) == std::string::npos) return {};
  return BadInput(place + ": the image '" + image +
                  "' has white space, ',' or '#' in its path, which the list of corners parts its "
                  "entries by; rename the file or folder, for example with '_', and correct the "
                  "cell");
}

Status CheckImageFile(const std::string& place, const fs::path& folder, const fs::path& inside) {
  std::error_code code;
  const auto status = fs::status(folder / inside, code);
  if (!fs::exists(status))
    return BadInput(place + ": the image '" + inside.string() + "' is not in " + folder.string() +
                    "; copy it there or correct the cell");
  if (!fs::is_regular_file(status))
    return BadInput(place + ": the image '" + inside.string() +
                    "' is a folder or device, a file was expected; correct the cell");
  if (::access((folder / inside).c_str(), R_OK) != 0)
    return BadInput(place + ": the image '" + inside.string() +
                    "' cannot be read: " + std::strerror(errno) + "; allow reading it");
  return {};
}

// The image of a row: inside the folder, there, and in no earlier row of any table.
Result<std::string> ReadImage(const TableReader& table, int row, const fs::path& folder,
                              SeenImages& seen, bool must_be_there = true) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string image, table.Text(row, "image"));
  const std::string place = table.Place(row);
  TELESTRAIN_RETURN_IF_ERROR(CheckImageName(place, image));
  const fs::path inside = fs::path(image).lexically_normal();
  TELESTRAIN_ASSIGN_OR_RETURN(
      const fs::path followed,
      PathInside(place + ": the image '" + PrintableText(image) + "'", folder, inside));
  const auto [at, is_new] = seen.emplace(followed.generic_string(), place);
  if (!is_new)
    return BadInput(place + ": the image '" + image + "' is already used at " + at->second +
                    "; an image belongs to one row of one table: remove one of the two");
  if (must_be_there) TELESTRAIN_RETURN_IF_ERROR(CheckImageFile(place, folder, inside));
  return image;
}

Status ReadCalibrationTable(Session& session, SeenImages& seen) {
  const fs::path path = session.folder / "calibration.csv";
  TELESTRAIN_ASSIGN_OR_RETURN(const TableReader table,
                              OpenTable(path, {{"image", "pose", "stage_mm"}, {}, false}));
  if (table.size() == 0)
    return BadInput(table.HeaderPlace() + ": has no rows; list at least one image of the target");
  for (int row = 0; row < table.size(); ++row) {
    CalibrationImage& image = session.calibration_images.emplace_back();
    TELESTRAIN_ASSIGN_OR_RETURN(
        image.image, ReadImage(table, row, session.folder, seen, !session.corners_are_given));
    TELESTRAIN_ASSIGN_OR_RETURN(image.pose, table.Text(row, "pose"));
    TELESTRAIN_ASSIGN_OR_RETURN(image.stage_mm, table.Number(row, "stage_mm"));
  }
  return {};
}

// A table whose artefact is not described cannot be evaluated.
Status RequireArtefact(const Session& session, const TableReader& table, bool described,
                       const std::string& key) {
  if (described || table.size() == 0) return {};
  return BadInput(table.Place(0) + ": lists images, but " +
                  (session.folder / "session.toml").string() + " has no [" + key + "]; add [" +
                  key + "] there or remove " + table.table().name);
}

Status ReadRulerTable(Session& session, SeenImages& seen) {
  const fs::path path = session.folder / "ruler.csv";
  if (!IsThere(path)) return {};
  TELESTRAIN_ASSIGN_OR_RETURN(const TableReader table, OpenTable(path, {{"image"}, {}, false}));
  TELESTRAIN_RETURN_IF_ERROR(RequireArtefact(session, table, session.ruler.length_mm > 0, "ruler"));
  for (int row = 0; row < table.size(); ++row) {
    TELESTRAIN_ASSIGN_OR_RETURN(session.ruler_images.emplace_back(),
                                ReadImage(table, row, session.folder, seen));
  }
  return {};
}

// Every gauge whose place is given reads into a column.
Status CheckGaugeColumns(const Session& session, const TableReader& table) {
  for (const PipeGauge& gauge : session.pipe.gauges) {
    if (IsGaugeColumn(gauge.column) && table.Has(gauge.column)) continue;
    return BadInput(table.HeaderPlace() + ": has no gauge column '" + gauge.column +
                    "', which a [[pipe.gauge]] of session.toml names (nearest column: '" +
                    NearestWord(gauge.column, table.table().columns) +
                    "'); correct its 'column' or add the readings");
  }
  return {};
}

// `images_are_there`: whether every image must lie in `folder` already.
Status FillPipeStates(const TableReader& table, const fs::path& folder, bool images_are_there,
                      SeenImages& seen, Session& session) {
  session.gauge_columns.clear();
  session.pipe_states.clear();
  std::copy_if(table.table().columns.begin(), table.table().columns.end(),
               std::back_inserter(session.gauge_columns), IsGaugeColumn);
  for (int row = 0; row < table.size(); ++row) {
    PipeState& state = session.pipe_states.emplace_back();
    TELESTRAIN_ASSIGN_OR_RETURN(state.image, ReadImage(table, row, folder, seen, images_are_there));
    state.cycle = table.Cell(row, "cycle");
    state.step = table.Cell(row, "step");
    TELESTRAIN_ASSIGN_OR_RETURN(state.time_s, table.OptionalNumber(row, "time_s"));
    TELESTRAIN_ASSIGN_OR_RETURN(state.temperature_c, table.OptionalNumber(row, "temperature_c"));
    for (const std::string& gauge : session.gauge_columns) {
      TELESTRAIN_ASSIGN_OR_RETURN(state.gauges_microstrain.emplace_back(),
                                  table.OptionalNumber(row, gauge));
    }
  }
  return {};
}

Result<TableReader> OpenPipeTable(const fs::path& path) {
  return OpenTable(path, {{"image", "cycle", "step"}, {"time_s", "temperature_c"}, true});
}

Status ReadPipeTable(Session& session, SeenImages& seen) {
  const fs::path path = session.folder / "pipe.csv";
  if (!IsThere(path)) return {};
  TELESTRAIN_ASSIGN_OR_RETURN(const TableReader table, OpenPipeTable(path));
  TELESTRAIN_RETURN_IF_ERROR(
      RequireArtefact(session, table, session.pipe.outer_diameter_mm > 0, "pipe"));
  TELESTRAIN_RETURN_IF_ERROR(CheckGaugeColumns(session, table));
  return FillPipeStates(table, session.folder, true, seen, session);
}

}  // namespace

Status ReadTables(Session& session) {
  SeenImages seen;
  TELESTRAIN_RETURN_IF_ERROR(ReadCalibrationTable(session, seen));
  TELESTRAIN_RETURN_IF_ERROR(ReadRulerTable(session, seen));
  return ReadPipeTable(session, seen);
}

Result<PipeTable> ReadPipeTableOf(const Session& session, const fs::path& table) {
  TELESTRAIN_ASSIGN_OR_RETURN(const TableReader reader, OpenPipeTable(table));
  TELESTRAIN_RETURN_IF_ERROR(CheckGaugeColumns(session, reader));
  Session holder;
  SeenImages seen;
  TELESTRAIN_RETURN_IF_ERROR(FillPipeStates(reader, table.parent_path(), false, seen, holder));
  return PipeTable{std::move(holder.gauge_columns), std::move(holder.pipe_states)};
}

}  // namespace telestrain
