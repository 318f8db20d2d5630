#include "style/source_file.h"

#include <cctype>

namespace telestrain::style {
namespace {

bool IsWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// Blanks [from, to) but keeps line ends.
void Blank(std::string& text, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to && i < text.size(); ++i)
    if (text[i] != '\n') text[i] = ' ';
}

// Index just after the literal that opens at `i` with a quotation mark or an apostrophe.
std::size_t EndOfLiteral(std::string_view text, std::size_t i) {
  const char quote = text[i];
  for (++i; i < text.size() && text[i] != quote && text[i] != '\n'; ++i)
    if (text[i] == '\\') ++i;
  return i + 1;
}

// Index just after the raw string whose quotation mark is at `i`: R"tag( … )tag".
std::size_t EndOfRawString(std::string_view text, std::size_t i) {
  const std::size_t open = text.find('(', i);
  if (open == std::string_view::npos) return text.size();
  const std::string close = ")" + std::string(text.substr(i + 1, open - i - 1)) + "\"";
  const std::size_t end = text.find(close, open);
  return end == std::string_view::npos ? text.size() : end + close.size();
}

// Index just after the comment at `i`, or `i` when there is none.
std::size_t EndOfComment(std::string_view text, std::size_t i) {
  if (text.substr(i, 2) == "//") return std::min(text.find('\n', i), text.size());
  if (text.substr(i, 2) != "/*") return i;
  const std::size_t end = text.find("*/", i + 2);
  return end == std::string_view::npos ? text.size() : end + 2;
}

void BlankPreprocessorLines(std::string& text) {
  bool continued = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::size_t first = text.find_first_not_of(' ', begin);
    const bool directive = continued || (first < end && text[first] == '#');
    continued = directive && end > begin && text[end - 1] == '\\';
    if (directive) Blank(text, begin, end);
    begin = end + 1;
  }
}

}  // namespace

std::vector<std::string> Lines(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::string CodeOnly(std::string_view text) {
  std::string code(text);
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t comment_end = EndOfComment(text, i);
    if (comment_end != i) {
      Blank(code, i, comment_end);
      i = comment_end;
    } else if (text[i] == '"') {
      const bool raw = i > 0 && text[i - 1] == 'R';
      const std::size_t end = raw ? EndOfRawString(text, i) : EndOfLiteral(text, i);
      Blank(code, i + 1, end - 1);
      i = end;
    } else if (text[i] == '\'' && !(i > 0 && IsWordCharacter(text[i - 1]))) {
      // After a letter or digit an apostrophe separates digits, as in 1'000.
      const std::size_t end = EndOfLiteral(text, i);
      Blank(code, i + 1, end - 1);
      i = end;
    } else {
      ++i;
    }
  }
  BlankPreprocessorLines(code);
  return code;
}

std::string FolderOf(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? "" : std::string(path.substr(0, slash));
}

std::string NameOf(std::string_view path) {
  return std::string(path.substr(path.rfind('/') + 1));  // npos + 1 is 0
}

bool IsHeader(std::string_view path) { return path.ends_with(".h"); }
bool IsCpp(std::string_view path) { return path.ends_with(".cpp"); }

std::string ModuleOf(std::string_view path) {
  if (path.starts_with("src/"))
    path.remove_prefix(4);
  else if (!path.starts_with("viz/") && !path.starts_with("report/"))
    return "";
  const std::size_t slash = path.find('/');
  return slash == std::string_view::npos ? "" : std::string(path.substr(0, slash));
}

std::string Finding(const SourceFile& file, std::size_t line, const std::string& message) {
  return file.path + ":" + std::to_string(line) + ": " + message;
}

}  // namespace telestrain::style
