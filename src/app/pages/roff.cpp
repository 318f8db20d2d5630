#include "app/pages/roff.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "report/unicode_text.h"

namespace telestrain {
namespace {

std::string InCapitals(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string Escaped(char32_t point) {
  switch (point) {
    case U'\\':
      return "\\e";
    case U'-':
      return "\\-";  // a plain one may be drawn as a hyphen, which cannot be pasted into a shell
    case U'\'':
      return "\\(aq";
    case U'`':
      return "\\(ga";
    case U'^':
      return "\\(ha";
    case U'~':
      return "\\(ti";
    case U'"':
      return "\\(dq";
    default:
      break;
  }
  if (point < 0x80) return std::string(1, static_cast<char>(point));
  std::array<char, 16> code{};
  std::snprintf(code.data(), code.size(), "\\[u%04X]", static_cast<unsigned>(point));
  return code.data();
}

// One line of text; a control character at its start must not make it a request.
std::string Line(const std::string& text) {
  const std::string line = RoffText(text);
  const bool is_request = !line.empty() && (line.front() == '.' || line.front() == ' ');
  return (is_request ? "\\&" : "") + line;
}

bool IsPlaceholder(const std::string& word) {
  bool has_capital = false;
  for (const char c : word) {
    if (c >= 'a' && c <= 'z' && c != 'x') return false;  // the x of WIDTHxHEIGHT
    has_capital = has_capital || (c >= 'A' && c <= 'Z');
  }
  return has_capital && word.front() != '-';
}

// "--out FOLDER" in bold with the value in italics.
std::string OptionText(const std::string& tag) {
  std::string text;
  for (std::size_t begin = 0; begin < tag.size();) {
    const std::size_t end = std::min(tag.find(' ', begin), tag.size());
    const std::string word = tag.substr(begin, end - begin);
    const char* font = IsPlaceholder(word) ? "\\fI" : "\\fB";
    text += (text.empty() ? "" : " ") + std::string(font) + RoffText(word) + "\\fR";
    begin = end + 1;
  }
  return text;
}

std::string WithoutBreaks(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

}  // namespace

std::string RoffText(const std::string& text) {
  std::string shown;
  for (const char32_t point : CodePoints(text)) shown += Escaped(point);
  return shown;
}

RoffPage::RoffPage(const std::string& name, const std::string& date, const std::string& source)
    : text_(".TH " + RoffText(InCapitals(name)) + " 1 \"" + date + "\" \"" + source +
            "\" \"User Commands\"\n") {}

void RoffPage::Section(const std::string& name) { text_ += ".SH " + name + "\n"; }

void RoffPage::Subsection(const std::string& name) { text_ += ".SS \"" + RoffText(name) + "\"\n"; }

void RoffPage::Name(const std::string& name, const std::string& summary) {
  text_ += RoffText(name) + " \\- " + RoffText(summary) + "\n";
}

void RoffPage::Paragraph(const std::string& text) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    if (begin > 0) text_ += ".PP\n";
    text_ += Line(WithoutBreaks(text.substr(begin, end - begin))) + "\n";
    begin = end + 2;
  }
}

void RoffPage::NextParagraph(const std::string& text) {
  text_ += ".PP\n";
  Paragraph(text);
}

void RoffPage::Tagged(const std::string& tag, const std::string& text) {
  text_ += ".TP\n\\fB" + RoffText(tag) + "\\fR\n" + Line(WithoutBreaks(text)) + "\n";
}

void RoffPage::TaggedOption(const std::string& tag, const std::string& text) {
  text_ += ".TP\n" + OptionText(tag) + "\n" + Line(WithoutBreaks(text)) + "\n";
}

void RoffPage::Lines(const std::string& text) {
  const std::size_t last = text_.rfind('\n', text_.size() - 2) + 1;
  const bool begins_section = text_.compare(last, 3, ".SH") == 0;
  text_ += std::string(begins_section ? "" : ".PP\n") + ".nf\n.RS 2\n";
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    text_ += Line(text.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  text_ += ".RE\n.fi\n";
}

void RoffPage::Synopsis(const std::string& command, const std::string& rest) {
  if (!text_.ends_with(".SH SYNOPSIS\n")) text_ += ".br\n";
  text_ += "\\fB" + RoffText(command) + "\\fR " + OptionText(rest) + "\n";
}

}  // namespace telestrain
