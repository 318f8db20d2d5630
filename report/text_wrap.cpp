#include "report/text_wrap.h"

#include <algorithm>

#include "report/unicode_text.h"

namespace telestrain {
namespace {

// Rounding in the width sums must not push a word that fits exactly onto the next line.
constexpr double kSlack_pt = 0.01;

struct Word {
  std::string text;
  bool space_before = false;
  bool new_line_before = false;
};

// Whether a line may break between two pieces that no space parts.
bool MayBreakBetween(const std::string& before, const std::string& behind) {
  return !MayNotEndLine(CodePoints(before).back()) && !MayNotBeginLine(CodePoints(behind).front());
}

std::vector<Word> SplitWords(const std::string& text) {
  std::vector<Word> words;
  Word next;
  const auto flush = [&] {
    if (next.text.empty()) return;
    const bool joined = !words.empty() && !next.space_before && !next.new_line_before;
    if (joined && !MayBreakBetween(words.back().text, next.text))
      words.back().text += next.text;
    else
      words.push_back(next);
    next = {};
  };
  for (const char32_t point : CodePoints(text)) {
    if (point == U'\n') {
      flush();
      next.new_line_before = true;
    } else if (point == U' ' || point == U'\t' || point == U'\r') {
      flush();
      next.space_before = true;
    } else if (BreaksAnywhere(point)) {
      flush();
      next.text = Utf8(point);
      flush();
    } else {
      next.text += Utf8(point);
    }
  }
  flush();
  return words;
}

// The longest prefix of `points` that fits, at least one; cut behind punctuation if there is one.
std::size_t FittingPrefix(PdfDocument& pdf, const TextStyle& style,
                          const std::vector<char32_t>& points, double width_pt) {
  std::size_t fitting = 0, behind_punctuation = 0;
  std::string prefix;
  for (const char32_t point : points) {
    prefix += Utf8(point);
    if (pdf.TextWidth_pt(style, prefix) > width_pt + kSlack_pt) break;
    ++fitting;
    if (point < 0x80 && std::string("/_-.,:;").find(static_cast<char>(point)) != std::string::npos)
      behind_punctuation = fitting;
  }
  if (fitting == points.size()) return fitting;
  return std::max<std::size_t>(behind_punctuation > 0 ? behind_punctuation : fitting, 1);
}

// Cuts a word that is wider than the line into pieces that fit.
std::vector<std::string> CutWord(PdfDocument& pdf, const TextStyle& style, const std::string& word,
                                 double width_pt) {
  std::vector<std::string> pieces;
  std::vector<char32_t> rest = CodePoints(word);
  while (!rest.empty()) {
    const std::size_t length = FittingPrefix(pdf, style, rest, width_pt);
    std::string piece;
    for (std::size_t i = 0; i < length; ++i) piece += Utf8(rest[i]);
    pieces.push_back(piece);
    rest.erase(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(length));
  }
  return pieces;
}

}  // namespace

std::vector<std::string> WrapText(PdfDocument& pdf, const TextStyle& style, const std::string& text,
                                  double width_pt) {
  std::vector<std::string> lines(1);
  const auto start_line = [&](const Word& word) {
    if (lines.back().empty()) return;
    if (word.space_before || word.new_line_before) lines.back() += ' ';
    lines.emplace_back();
  };
  for (const Word& word : SplitWords(text)) {
    if (word.new_line_before) start_line(word);
    const bool joined = !lines.back().empty();
    const std::string longer = lines.back() + (joined && word.space_before ? " " : "") + word.text;
    if (pdf.TextWidth_pt(style, longer) <= width_pt + kSlack_pt) {
      lines.back() = longer;
      continue;
    }
    start_line(word);
    for (const std::string& piece : CutWord(pdf, style, word.text, width_pt)) {
      if (!lines.back().empty()) lines.emplace_back();
      lines.back() = piece;
    }
  }
  return lines;
}

double WidestWord_pt(PdfDocument& pdf, const TextStyle& style, const std::string& text) {
  double widest_pt = 0;
  for (const Word& word : SplitWords(text))
    widest_pt = std::max(widest_pt, pdf.TextWidth_pt(style, word.text));
  return widest_pt;
}

std::string ShortenedText(PdfDocument& pdf, const TextStyle& style, const std::string& text,
                          double room_pt) {
  if (pdf.TextWidth_pt(style, text) <= room_pt) return text;
  std::string shown;
  for (const char32_t point : CodePoints(text)) {
    if (pdf.TextWidth_pt(style, shown + Utf8(point) + "…") > room_pt) break;
    shown += Utf8(point);
  }
  return shown + "…";
}

}  // namespace telestrain
