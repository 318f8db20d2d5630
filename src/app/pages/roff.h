#pragma once

#include <string>

namespace telestrain {

// A manual page in the macros of man(7), made line by line. Texts are plain UTF-8: what roff would
// read as a request, an escape or a typographic quote is written so that it shows as it stands, and
// characters beyond ASCII as their code points, so that no locale changes a page.
class RoffPage {
 public:
  // The title is the name in capitals; the section is 1.
  RoffPage(const std::string& name, const std::string& date, const std::string& source);

  void Section(const std::string& name);
  void Subsection(const std::string& name);
  // The line of the section NAME, by which apropos finds the page.
  void Name(const std::string& name, const std::string& summary);
  // An empty line in the text begins another one.
  void Paragraph(const std::string& text);
  // One that follows another.
  void NextParagraph(const std::string& text);
  // A tag in bold, its text indented below.
  void Tagged(const std::string& tag, const std::string& text);
  // As Tagged, with words in capitals (FILE, N) in italics instead of bold.
  void TaggedOption(const std::string& tag, const std::string& text);
  // Lines that keep their breaks and blanks.
  void Lines(const std::string& text);
  // A way to call a command; each begins a line.
  void Synopsis(const std::string& command, const std::string& rest);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// The text as roff shows it; for tests.
std::string RoffText(const std::string& text);

}  // namespace telestrain
