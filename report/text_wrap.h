#pragma once

#include <string>
#include <vector>

#include "report/pdf_document.h"

namespace telestrain {

// `text` in lines of at most `width_pt`. Breaks at spaces and line feeds, between Chinese
// characters, and inside a word only when the word alone is wider: then behind one of "/_-.,:;"
// where possible. At least one line; nothing of the text is lost but the spaces at the breaks.
std::vector<std::string> WrapText(PdfDocument& pdf, const TextStyle& style, const std::string& text,
                                  double width_pt);

// Width of the widest piece that WrapText does not break unless it must.
double WidestWord_pt(PdfDocument& pdf, const TextStyle& style, const std::string& text);

// The longest beginning of `text` that fits, with an ellipsis when it is not all of it.
std::string ShortenedText(PdfDocument& pdf, const TextStyle& style, const std::string& text,
                          double room_pt);

}  // namespace telestrain
