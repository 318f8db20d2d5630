#include "style/size_rules.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>

namespace telestrain::style {
namespace {

enum class Block { kScope, kFunction, kControl, kOther };

bool IsSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::string Trimmed(std::string_view text) {
  while (!text.empty() && IsSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsSpace(text.back())) text.remove_suffix(1);
  return std::string(text);
}

std::string FirstWord(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() &&
         (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
    ++end;
  return std::string(text.substr(0, end));
}

bool IsOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// `header` without a leading `template <…>`.
std::string WithoutTemplate(std::string header) {
  while (header.starts_with("template")) {
    std::size_t end = header.find('<');
    for (int depth = 0; end < header.size(); ++end) {
      if (header[end] == '<') ++depth;
      if (header[end] == '>' && --depth == 0) break;
    }
    header = end < header.size() ? Trimmed(header.substr(end + 1)) : "";
  }
  return header;
}

bool EndsAsFunctionHead(const std::string& header) {
  const std::size_t close = header.rfind(')');
  if (close == std::string::npos) return false;
  const std::string after = Trimmed(header.substr(close + 1));
  if (after.empty() || after.find("->") != std::string::npos) return true;
  // The last word decides: `) const noexcept` opens a body, `), rows_` an initializer.
  const std::size_t blank = after.find_last_of(" \n");
  const std::string last = blank == std::string::npos ? after : after.substr(blank + 1);
  return IsOneOf(last, {"const", "noexcept", "override", "final", "mutable", "try", "}"});
}

// What the brace after `header` opens; `header` is what stands since the last ';' or brace.
Block Classify(const std::string& raw_header, bool in_function) {
  const std::string header = WithoutTemplate(Trimmed(raw_header));
  const std::string word = FirstWord(header);
  if (in_function) {
    const bool control =
        IsOneOf(word, {"if", "for", "while", "switch", "do", "else", "try", "catch"});
    return control ? Block::kControl : Block::kOther;
  }
  if (IsOneOf(word, {"namespace", "class", "struct", "union", "enum", "extern"}))
    return Block::kScope;
  if (header.starts_with("inline namespace")) return Block::kScope;
  return EndsAsFunctionHead(header) ? Block::kFunction : Block::kOther;
}

class Scanner {
 public:
  explicit Scanner(std::string_view text) : code_(CodeOnly(text)), lines_(Lines(text)) {}

  std::vector<Function> Scan() {
    for (at_ = 0; at_ < code_.size(); ++at_) {
      const char c = code_[at_];
      if (c == '{')
        Open();
      else if (c == '}')
        Close();
      else if (c == ';' && parentheses_ == 0)
        StartHeader();
      else
        AddToHeader(c);
      if (c == '\n') ++line_;
    }
    return functions_;
  }

 private:
  void StartHeader() { header_.clear(); }

  void AddToHeader(char c) {
    if (c == '(') ++parentheses_;
    if (c == ')') --parentheses_;
    // Labels end what stands before them: `public:`, `case kMean:`.
    const bool label = c == ':' && IsOneOf(FirstWord(Trimmed(header_)),
                                           {"public", "private", "protected", "case", "default"});
    if (label && code_[at_ + 1] != ':' && header_.back() != ':') return StartHeader();
    if (Trimmed(header_).empty() && !IsSpace(c)) header_line_ = line_;
    header_ += c;
  }

  void Open() {
    const Block block = Classify(header_, InFunction());
    blocks_.push_back(block);
    kept_parentheses_.push_back(parentheses_);
    parentheses_ = 0;
    if (block == Block::kFunction) StartFunction();
    if (block == Block::kControl) CountNesting();
    kept_headers_.push_back(header_);
    StartHeader();
  }

  void Close() {
    if (blocks_.empty()) return;
    const Block block = blocks_.back();
    blocks_.pop_back();
    parentheses_ = kept_parentheses_.back();
    kept_parentheses_.pop_back();
    const std::string before = kept_headers_.back();
    kept_headers_.pop_back();
    if (block == Block::kFunction)
      functions_.back().lines = line_ - functions_.back().first_line + 1;
    // An initializer such as `rows_{2}` or a lambda in an argument is a part of what goes on.
    if (block == Block::kOther && !Trimmed(before).empty())
      header_ = before + " }";
    else
      StartHeader();
  }

  bool InFunction() const {
    return std::find(blocks_.begin(), blocks_.end(), Block::kFunction) != blocks_.end();
  }

  void StartFunction() {
    const auto index = static_cast<std::size_t>(header_line_ - 1);
    functions_.push_back({index < lines_.size() ? lines_[index] : "", header_line_, 0, 0});
  }

  void CountNesting() {
    const auto depth = std::count(blocks_.begin(), blocks_.end(), Block::kControl);
    functions_.back().nesting = std::max(functions_.back().nesting, static_cast<int>(depth));
  }

  std::string code_;
  std::vector<std::string> lines_;
  std::vector<Function> functions_;
  std::vector<Block> blocks_;
  std::vector<std::string> kept_headers_;
  std::vector<int> kept_parentheses_;
  std::string header_;
  std::size_t at_ = 0;
  int parentheses_ = 0;
  int line_ = 1;
  int header_line_ = 1;
};

std::string Describe(const Function& function) {
  return std::to_string(function.lines) + " lines, nesting " + std::to_string(function.nesting) +
         ": " + function.signature;
}

bool HoldsCpp(std::string_view path) { return IsHeader(path) || IsCpp(path); }

}  // namespace

std::vector<Function> FunctionsOf(std::string_view text) { return Scanner(text).Scan(); }

Findings CheckFileSize(const SourceFile& file) {
  const std::size_t count = Lines(file.text).size();
  if (!HoldsCpp(file.path) || count <= kMaxFileLines) return {};
  return {Finding(file, count,
                  std::to_string(count) + " lines, at most " + std::to_string(kMaxFileLines))};
}

Findings CheckFunctions(const SourceFile& file) {
  Findings findings;
  if (!HoldsCpp(file.path)) return findings;
  for (const Function& function : FunctionsOf(file.text))
    if (function.lines > kMaxFunctionLines || function.nesting > kMaxNesting)
      findings.push_back(
          Finding(file, static_cast<std::size_t>(function.first_line), Describe(function)));
  return findings;
}

Findings SizeWarnings(const SourceFile& file) {
  Findings warnings;
  if (!HoldsCpp(file.path)) return warnings;
  const std::size_t count = Lines(file.text).size();
  if (count > kWantedFileLines)
    warnings.push_back(Finding(file, count, std::to_string(count) + " lines"));
  for (const Function& function : FunctionsOf(file.text))
    if (function.lines > kWantedFunctionLines)
      warnings.push_back(
          Finding(file, static_cast<std::size_t>(function.first_line), Describe(function)));
  return warnings;
}

}  // namespace telestrain::style
