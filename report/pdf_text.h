#pragma once

// Included by the pdf_*.cpp files only: libharu stays inside them.

#include <array>
#include <string>
#include <vector>

#include "base/result.h"
#include "report/page_geometry.h"
#include "report/pdf_font.h"

namespace telestrain {

// The fonts of a document: loaded when the first character needs one, with others to fall back on.
class PdfFonts {
 public:
  struct Run {  // characters of one font
    PdfFont* font = nullptr;
    std::string utf8;
    double advance = 0;  // thousandths of the font size
  };

  PdfFonts();
  // Fails (kOutputFailed) when a font that the report cannot be made without is not installed.
  Status CheckInstalled() const;

  // Control characters become spaces; a character that no font has becomes its name, "[U+1F600]".
  // Clears `ok` when libharu could not load a font.
  std::vector<Run> Runs(HPDF_Doc document, Face face, const std::string& text, bool& ok);

  // To be called once, before saving.
  bool Finish(PdfObjects& objects, bool with_cid_set);

 private:
  enum Index { kSans, kSansBold, kMono, kSymbols, kSymbolsBold, kChinese, kCount };
  static const std::vector<Index>& FallbackChain(Face face);
  PdfFont* FontFor(HPDF_Doc document, Face face, char32_t point);

  std::array<PdfFont, kCount> fonts_;
};

}  // namespace telestrain
