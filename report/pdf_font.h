#pragma once

// Included by the pdf_*.cpp files only: libharu stays inside them.

#include <hpdf.h>
#include <hpdf_doc.h>
#include <hpdf_font.h>
#include <hpdf_fontdef.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "report/pdf_objects.h"

namespace telestrain {

// A TrueType file, found on this machine and loaded into a document when the first character needs
// it. libharu 2.3.0 is corrected where its output would be wrong: see FinishFont.
struct PdfFont {
  std::filesystem::path path;  // empty: not installed
  int collection_index = -1;   // of a .ttc file, else -1
  std::string package;         // the Debian package that holds it, for errors
  bool required = false;       // the report cannot be made without it
  HPDF_Font font = nullptr;
  std::set<HPDF_UINT16> used;  // code points drawn so far

  bool loaded() const { return font != nullptr; }
  HPDF_FontDef definition() const { return reinterpret_cast<HPDF_FontAttr>(font->attr)->fontdef; }
  HPDF_UINT16 GlyphOf(char32_t code_point) const;
  double Advance(char32_t code_point) const;  // in thousandths of the font size
};

// The first existing file of `candidates`.
PdfFont FindFont(const std::vector<std::string>& candidates, int collection_index,
                 const std::string& package, bool required);

// Loads the file into `document` for UTF-8 text; false when libharu refused.
bool LoadFont(HPDF_Doc document, PdfFont& font);

// To be called once, before saving: marks the parts of composite glyphs of every depth (libharu
// marks the first level only and the others vanish), writes a well-formed ToUnicode map, keeps
// widths and glyph map of the used characters only, and completes the descriptor with what PDF/A
// wants: the height of capitals and, of PDF/A-1, the set of characters. False when libharu failed.
bool FinishFont(PdfObjects& objects, PdfFont& font, bool with_cid_set);

}  // namespace telestrain
