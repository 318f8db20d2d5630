#include "target/corners_file.h"

#include <cmath>
#include <optional>
#include <sstream>

#include "base/files.h"
#include "base/numbers.h"

namespace telestrain {
namespace {

constexpr char kLegend[] = "# filename x y level";
constexpr int kLargestLevel = 20;  // of halvings; no image has more
constexpr char kNotSeen[] = "no corners in the corner table";

std::string Place(const std::string& name, int line) {
  return name + ":" + std::to_string(line) + ": ";
}

// One line: the board's name (which may hold spaces) and the corner, if any.
struct CornerLine {
  std::string board;
  std::optional<ImagePoint> corner;
};

// Cuts the last blank-separated word off `text`.
std::string CutLastWord(std::string* text) {
  const auto end = text->find_last_not_of(" \t\r");
  text->erase(end == std::string::npos ? 0 : end + 1);
  const auto blank = text->find_last_of(" \t");
  const std::size_t begin = blank == std::string::npos ? 0 : blank + 1;
  std::string word = text->substr(begin);
  text->erase(begin);
  return word;
}

// The columns that the file's legend names.
struct Columns {
  bool has_level = true;
};

// `# filename x y` or `# filename x y level`; nothing for any other comment.
std::optional<Columns> ParseLegend(const std::string& line) {
  std::istringstream words(line);
  std::vector<std::string> names;
  for (std::string word; words >> word;) names.push_back(word);
  if (!names.empty() && names[0].size() > 1 && names[0][0] == '#')
    names = [&names] {
      std::vector<std::string> split{"#", names[0].substr(1)};
      split.insert(split.end(), names.begin() + 1, names.end());
      return split;
    }();
  if (names == std::vector<std::string>{"#", "filename", "x", "y"}) return Columns{false};
  if (names == std::vector<std::string>{"#", "filename", "x", "y", "level"}) return Columns{true};
  return std::nullopt;
}

// A corner as mrcal reads it: nothing where a field is `-` or the level is negative.
Result<std::optional<ImagePoint>> ParseCorner(const std::string& where, const std::string& x,
                                              const std::string& y, const std::string& level) {
  if (x == "-" || y == "-" || level == "-") return std::optional<ImagePoint>();
  const auto u = ParseDouble(x), v = ParseDouble(y);
  if (!u || !v)
    return BadInput(where + "'" + (u ? y : x) + "' is not a number; write x y level or - - -");
  const auto decimation = ParseInt(level);
  if (!decimation || *decimation > kLargestLevel)
    return BadInput(where + "level '" + level + "' is not a whole number of at most " +
                    std::to_string(kLargestLevel));
  if (*decimation < 0 || *u < 0 || *v < 0) return std::optional<ImagePoint>();
  return std::optional(ImagePoint{
      {*u, *v}, std::pow(4.0, static_cast<double>(*decimation)) * Eigen::Matrix2d::Identity()});
}

Result<CornerLine> ParseLine(const std::string& where, std::string text, Columns columns) {
  const std::string whole = text;
  const std::string level = columns.has_level ? CutLastWord(&text) : "0";
  const std::string y = CutLastWord(&text), x = CutLastWord(&text);
  const auto first = text.find_first_not_of(" \t");
  const auto last = text.find_last_not_of(" \t\r");
  if (first == std::string::npos)
    return BadInput(where + "'" + whole + "' has too few fields; write filename x y" +
                    (columns.has_level ? " level" : ""));
  CornerLine line;
  line.board = text.substr(first, last - first + 1);
  if (line.board.find('#') == std::string::npos)
    return BadInput(where + "'" + line.board + "' does not name a view; write <image>#<view>");
  TELESTRAIN_ASSIGN_OR_RETURN(line.corner, ParseCorner(where, x, y, level));
  return line;
}

// Ends a block: a lone missing corner is a rejected board.
Status CloseBlock(const std::string& where, int corner_count, BoardObservation* board) {
  const auto count = static_cast<int>(board->corners.size());
  const bool is_empty = std::none_of(board->corners.begin(), board->corners.end(),
                                     [](const auto& corner) { return corner.has_value(); });
  if (is_empty && (count == 1 || count == corner_count)) {
    board->corners.clear();
    board->rejected_because = kNotSeen;
    return {};
  }
  if (count == corner_count) return {};
  return BadInput(where + "the block of '" + board->image + "#" + board->view + "' has " +
                  std::to_string(count) + " corners, the board has " +
                  std::to_string(corner_count) + "; give every corner a line, - - - when missing");
}

}  // namespace

std::string CornersVnlText(const std::vector<BoardObservation>& boards) {
  std::ostringstream text;
  text << kLegend << '\n';
  for (const BoardObservation& board : boards) {
    const std::string name = board.image + "#" + board.view;
    if (board.corners.empty()) text << name << " - - -\n";
    for (const auto& corner : board.corners) {
      text << name << ' ';
      if (corner)
        text << FormatShortest(corner->pixel.x()) << ' ' << FormatShortest(corner->pixel.y())
             << " 0\n";
      else
        text << "- - -\n";
    }
  }
  return text.str();
}

Status WriteCornersVnl(const std::vector<BoardObservation>& boards,
                       const std::filesystem::path& path) {
  return WriteFileAtomically(path, CornersVnlText(boards));
}

Result<std::vector<BoardObservation>> ParseCornersVnl(const std::string& name,
                                                      const std::string& text, int corner_count) {
  std::vector<BoardObservation> boards;
  std::istringstream stream(text);
  std::string line;
  int number = 0;
  Columns columns;
  while (std::getline(stream, line)) {
    const std::string where = Place(name, ++number);
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    if (line[first] == '#') {
      columns = ParseLegend(line).value_or(columns);
      continue;
    }
    TELESTRAIN_ASSIGN_OR_RETURN(const CornerLine parsed, ParseLine(where, line, columns));
    const auto hash = parsed.board.find_last_of('#');
    const std::string image = parsed.board.substr(0, hash), view = parsed.board.substr(hash + 1);
    if (boards.empty() || boards.back().image != image || boards.back().view != view) {
      if (!boards.empty())
        TELESTRAIN_RETURN_IF_ERROR(CloseBlock(where, corner_count, &boards.back()));
      boards.push_back({image, view, {}, {}, number});
    }
    boards.back().corners.push_back(parsed.corner);
  }
  if (!boards.empty())
    TELESTRAIN_RETURN_IF_ERROR(CloseBlock(Place(name, number), corner_count, &boards.back()));
  return boards;
}

Result<std::vector<BoardObservation>> ReadCornersVnl(const std::filesystem::path& path,
                                                     int corner_count) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMostResultBytes));
  return ParseCornersVnl(path.string(), text, corner_count);
}

}  // namespace telestrain
