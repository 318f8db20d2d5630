#pragma once

#include <string>
#include <vector>

#include "report/pdf_document.h"

namespace telestrain {

// `text` in lines of at most `width_pt`. Breaks at spaces and line feeds, between Chinese
// characters but not before closing or behind opening punctuation, and inside a word only when the
// word alone is wider: then behind one of "/_-.,:;" where possible. At least one line. A line that
// was broken at a space or line feed ends with one space, which does not count for its width:
// tagged text holds its word breaks (PDF 32000-1, 14.8.2.5), and the lines together are the text
// with single spaces.
std::vector<std::string> WrapText(PdfDocument& pdf, const TextStyle& style, const std::string& text,
                                  double width_pt);

// Width of the widest piece that WrapText does not break unless it must.
double WidestWord_pt(PdfDocument& pdf, const TextStyle& style, const std::string& text);

// The longest beginning of `text` that fits, with an ellipsis when it is not all of it.
std::string ShortenedText(PdfDocument& pdf, const TextStyle& style, const std::string& text,
                          double room_pt);

}  // namespace telestrain
