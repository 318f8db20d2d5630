#include "docs/document.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

std::string Trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n"),
                    end = text.find_last_not_of(" \t\r\n");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

std::string FirstWord(const std::string& line) {
  return Trimmed(line).substr(0, Trimmed(line).find(' '));
}

// A command of the document, not a message such as "telestrain run: …".
bool IsCommand(const std::string& line) {
  const std::string text = Trimmed(line), rest = text.substr(FirstWord(text).size());
  return IsCommandWord(FirstWord(text)) && !FirstWord(rest).ends_with(':');
}

// A block of code with the comment that stood before it.
struct Block {
  int line = 0;  // of its first line
  std::vector<std::string> lines;
  std::string not_run;
};

ShownCommand CommandOf(const std::string& written, int line) {
  static const std::regex exit(R"(\s+# exit code (\d+)\s*$)");
  ShownCommand command;
  command.line = line;
  command.command = Trimmed(written);
  if (std::smatch found; std::regex_search(command.command, found, exit)) {
    command.exit_code = std::stoi(found[1]);
    command.command = found.prefix();
  }
  return command;
}

// The commands of a block; none when it is not one of commands.
std::vector<ShownCommand> CommandsOf(const Block& block) {
  std::vector<ShownCommand> commands;
  bool continues = false;
  for (std::size_t i = 0; i < block.lines.size(); ++i) {
    const std::string& line = block.lines[i];
    if (Trimmed(line).empty()) continue;
    if (continues)
      commands.back().command += " " + Trimmed(line);
    else if (IsCommand(line))
      commands.push_back(CommandOf(line, block.line + static_cast<int>(i)));
    else if (commands.empty())
      return {};
    else
      commands.back().output.push_back(line);
    std::string& last = commands.back().command;
    continues = commands.back().output.empty() && last.ends_with('\\');
    if (continues) last.pop_back();
  }
  return commands;
}

std::string AnchorOf(const std::string& heading) {
  std::string anchor;
  for (const char c : Trimmed(heading)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(byte) || c == '-' || c == '_' || byte >= 0x80)
      anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

class Reader {
 public:
  explicit Reader(Document& document) : document_(document) {}

  void Read() {
    for (at_ = 0; at_ < document_.lines.size(); ++at_) ReadLine(document_.lines[at_]);
  }

 private:
  void ReadLine(const std::string& line) {
    const bool after_text = text_before_;
    text_before_ = !Trimmed(line).empty();
    if (line.starts_with("<!--")) return ReadComment();
    if (line.starts_with("```")) return ReadFence(line);
    if (line.starts_with("    ") && !after_text && !in_list_) return ReadIndented();
    if (line.starts_with("|")) return ReadTable();
    if (Trimmed(line).empty()) return;
    in_list_ = line.starts_with("- ") || line.starts_with("* ") || (in_list_ && line[0] == ' ');
    if (line[0] == '#')
      document_.anchors.push_back(AnchorOf(line.substr(line.find_first_not_of('#'))));
    ReadText(line);
    not_run_.clear();
    figures_.clear();
  }

  void ReadComment() {
    std::string comment;
    const int first = static_cast<int>(at_) + 1;
    for (; at_ < document_.lines.size(); ++at_) {
      comment += document_.lines[at_] + "\n";
      if (document_.lines[at_].find("-->") != std::string::npos) break;
    }
    const std::string body = Trimmed(comment.substr(4, comment.find("-->") - 4));
    const auto after = [&](const std::string& word) { return Trimmed(body.substr(word.size())); };
    if (body.starts_with("not run:")) not_run_ = after("not run:");
    if (body.starts_with("figures:")) figures_ = after("figures:");
    if (body.starts_with("options:")) figures_ = body;  // a generated table
    if (!body.starts_with("run:")) return;
    std::istringstream lines(after("run:"));
    for (std::string line; std::getline(lines, line);) {
      document_.commands.push_back(CommandOf(line, first));
      document_.commands.back().shown = false;
    }
  }

  void ReadFence(const std::string& opening) {
    Block block{static_cast<int>(at_) + 2, {}, not_run_};
    const std::size_t ticks = opening.find_first_not_of('`');
    const std::string fence = opening.substr(0, ticks);
    const std::string language = ticks == std::string::npos ? "" : opening.substr(ticks);
    for (++at_; at_ < document_.lines.size() && document_.lines[at_] != fence; ++at_)
      block.lines.push_back(document_.lines[at_]);
    if (language != "synopsis") Keep(block);
  }

  void ReadIndented() {
    Block block{static_cast<int>(at_) + 1, {}, not_run_};
    const auto belongs = [](const std::string& line) {
      return line.starts_with("    ") || Trimmed(line).empty();
    };
    for (; at_ < document_.lines.size() && belongs(document_.lines[at_]); ++at_)
      block.lines.push_back(document_.lines[at_]);
    --at_;
    Keep(block);
    text_before_ = false;
  }

  void Keep(const Block& block) {
    const auto commands = CommandsOf(block);
    if (block.not_run.empty()) {
      document_.commands.insert(document_.commands.end(), commands.begin(), commands.end());
    } else {
      UntestedBlock untested{block.line, block.not_run, {}};
      for (const ShownCommand& command : commands) untested.commands.push_back(command.command);
      document_.untested.push_back(untested);
    }
    not_run_.clear();
  }

  void ReadTable() {
    Table table{static_cast<int>(at_) + 1, {}, figures_};
    for (; at_ < document_.lines.size() && document_.lines[at_].starts_with("|"); ++at_) {
      table.rows.push_back(document_.lines[at_]);
      ReadText(document_.lines[at_]);
    }
    --at_;
    document_.tables.push_back(table);
    figures_.clear();
  }

  void ReadText(const std::string& line) {
    static const std::regex code("`([^`]+)`"), link(R"(\]\(([^)\s]+)\))");
    for (std::sregex_iterator i(line.begin(), line.end(), code), end; i != end; ++i)
      document_.code_spans.push_back((*i)[1]);
    for (std::sregex_iterator i(line.begin(), line.end(), link), end; i != end; ++i)
      document_.links.push_back({static_cast<int>(at_) + 1, (*i)[1]});
  }

  Document& document_;
  std::size_t at_ = 0;
  bool text_before_ = false, in_list_ = false;
  std::string not_run_, figures_;
};

// Whether the pieces of `shown` between its '…' follow each other in `line`, from end to end.
bool DescribesLine(const std::string& shown, const std::string& line) {
  static const std::string any = "…";
  std::size_t from = 0, at = 0;
  while (true) {
    const std::size_t gap = shown.find(any, from);
    const std::string piece = shown.substr(from, gap == std::string::npos ? gap : gap - from);
    const bool first = from == 0, last = gap == std::string::npos;
    if (last && !first) return line.size() >= at + piece.size() && line.ends_with(piece);
    const std::size_t found = line.find(piece, at);
    if (found == std::string::npos || (first && found != 0)) return false;
    if (last) return line == piece;
    at = found + piece.size();
    from = gap + any.size();
  }
}

bool DescribesFrom(const std::vector<std::string>& shown, std::size_t i,
                   const std::vector<std::string>& lines, std::size_t k) {
  if (i == shown.size()) return k == lines.size();
  if (shown[i] == "…") {
    for (std::size_t next = k; next <= lines.size(); ++next)
      if (DescribesFrom(shown, i + 1, lines, next)) return true;
    return false;
  }
  return k < lines.size() && DescribesLine(shown[i], lines[k]) &&
         DescribesFrom(shown, i + 1, lines, k + 1);
}

}  // namespace

bool IsCommandWord(const std::string& word) {
  static const std::set<std::string> words = {"telestrain",
                                              "telestrain-view",
                                              "build/release/telestrain",
                                              "bash",
                                              "cmake",
                                              "ctest",
                                              "apt",
                                              "apt-get",
                                              "dpkg",
                                              "openssl",
                                              "mkdir",
                                              "cp",
                                              "mv",
                                              "rm",
                                              "sed",
                                              "sudo",
                                              "ls",
                                              "head",
                                              "man",
                                              "printf"};
  return words.contains(word);
}

Document ReadDocument(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  Document document;
  document.path = path;
  document.text = {std::istreambuf_iterator<char>(file), {}};
  std::istringstream lines(document.text);
  for (std::string line; std::getline(lines, line);) document.lines.push_back(line);
  Reader(document).Read();
  return document;
}

std::vector<fs::path> DocumentPaths(const fs::path& project) {
  std::vector<fs::path> paths;
  fs::recursive_directory_iterator entry(project), end;
  for (; entry != end; ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name[0] == '.' || name == "build"))
      entry.disable_recursion_pending();
    if (entry->path().extension() == ".md") paths.push_back(entry->path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool DescribesOutput(const std::vector<std::string>& shown, const std::string& printed) {
  std::vector<std::string> wanted, lines;
  for (const std::string& line : shown)
    if (!Trimmed(line).empty()) wanted.push_back(Trimmed(line));
  std::istringstream all(printed);
  for (std::string line; std::getline(all, line);)
    if (!Trimmed(line).empty()) lines.push_back(Trimmed(line));
  return DescribesFrom(wanted, 0, lines, 0);
}

}  // namespace telestrain::testing_support
