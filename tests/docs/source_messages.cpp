#include "docs/source_messages.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;
constexpr const char* kAny = "…";

// Index behind the literal that begins at `i`; its text is added to `text`.
std::size_t TakeLiteral(const std::string& code, std::size_t i, std::string& text) {
  for (++i; i < code.size() && code[i] != '"'; ++i) {
    if (code[i] == '\\') ++i;
    text += code[i];
  }
  return i + 1;
}

void AddAny(std::string& text) {
  if (!text.ends_with(kAny)) text += kAny;
}

// The message between the bracket at `i` and the one that closes it.
std::string MessageAt(const std::string& code, std::size_t i) {
  std::string text;
  int depth = 1;
  bool literal = false;
  for (++i; i < code.size() && depth > 0;) {
    const char c = code[i];
    if (c == '"') {
      i = TakeLiteral(code, i, text);
      literal = true;
      continue;
    }
    if (c == '(' || c == '{') ++depth;
    if (c == ')' || c == '}') --depth;
    if (depth > 0 && !std::isspace(static_cast<unsigned char>(c)) && c != '+') AddAny(text);
    ++i;
  }
  return literal ? text : "";
}

}  // namespace

std::vector<SourceMessage> MessagesOf(const std::string& code, const std::string& name) {
  static const std::regex call(
      R"(\b(BadInput|EstimationFailed|OutputFailed|WrongUsage|CannotRemove|Warn|Doubt)\(|\bError\{ErrorKind)");
  std::vector<SourceMessage> messages;
  for (std::sregex_iterator i(code.begin(), code.end(), call), end; i != end; ++i) {
    const auto at = static_cast<std::size_t>(i->position());
    const std::string text = MessageAt(code, code.find_first_of("({", at));
    const auto line = 1 + std::count(code.begin(), code.begin() + i->position(), '\n');
    if (!text.empty()) messages.push_back({name + ":" + std::to_string(line), text});
  }
  return messages;
}

std::vector<SourceMessage> MessagesOfModule(const fs::path& project, const std::string& module) {
  std::vector<SourceMessage> messages;
  for (const auto& entry : fs::directory_iterator(project / module)) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + entry.path().string());
    const std::string code{std::istreambuf_iterator<char>(file), {}};
    const auto found = MessagesOf(code, module + "/" + entry.path().filename().string());
    messages.insert(messages.end(), found.begin(), found.end());
  }
  return messages;
}

bool IsIn(const std::string& pattern, const std::string& text) {
  std::size_t at = 0;
  for (std::size_t from = 0; from != std::string::npos;) {
    const std::size_t gap = pattern.find(kAny, from);
    const std::string piece = pattern.substr(from, gap == std::string::npos ? gap : gap - from);
    const std::size_t found = text.find(piece, at);
    if (found == std::string::npos) return false;
    at = found + piece.size();
    from = gap == std::string::npos ? gap : gap + std::string(kAny).size();
  }
  return true;
}

}  // namespace telestrain::testing_support
