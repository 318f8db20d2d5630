#include "report/pdf_text.h"

#include "report/unicode_text.h"

namespace telestrain {
namespace {

constexpr const char* kFolder = "/usr/share/fonts/truetype/";

PdfFont Liberation(const std::string& file) {
  const std::string folder = kFolder;
  return FindFont({folder + "liberation2/" + file, folder + "liberation/" + file}, -1,
                  "fonts-liberation2", true);
}

PdfFont DejaVu(const std::string& file) {
  return FindFont({std::string(kFolder) + "dejavu/" + file}, -1, "fonts-dejavu-core", true);
}

// Code points to draw: control characters become spaces.
std::vector<char32_t> DrawablePoints(const std::string& text) {
  std::vector<char32_t> points = CodePoints(text);
  for (char32_t& point : points)
    if (point < 0x20 || (point >= 0x7F && point < 0xA0)) point = U' ';
  return points;
}

// Private characters mean nothing to a reader, and U+FEFF and U+FFFE may not be in a ToUnicode map.
bool IsMeaningless(char32_t point) {
  return (point >= 0xE000 && point <= 0xF8FF) || point == 0xFEFF || point == 0xFFFE ||
         point == 0xFFFF;
}

void AppendRun(std::vector<PdfFonts::Run>& runs, PdfFont* font, char32_t point) {
  if (runs.empty() || runs.back().font != font) runs.push_back({font, "", 0});
  runs.back().utf8 += Utf8(point);
  runs.back().advance += font->Advance(point);
  font->used.insert(static_cast<HPDF_UINT16>(point));
}

}  // namespace

PdfFonts::PdfFonts()
    : fonts_{
          Liberation("LiberationSans-Regular.ttf"),
          Liberation("LiberationSans-Bold.ttf"),
          Liberation("LiberationMono-Regular.ttf"),
          DejaVu("DejaVuSans.ttf"),
          DejaVu("DejaVuSans-Bold.ttf"),
          FindFont({std::string(kFolder) + "wqy/wqy-zenhei.ttc"}, 0, "fonts-wqy-zenhei", false)} {}

Status PdfFonts::CheckInstalled() const {
  for (const PdfFont& font : fonts_)
    if (font.required && font.path.empty())
      return OutputFailed("a font of the report is not installed under " + std::string(kFolder) +
                          "; install the package " + font.package);
  return {};
}

const std::vector<PdfFonts::Index>& PdfFonts::FallbackChain(Face face) {
  static const std::vector<Index> kRegularChain = {kSans, kSymbols, kChinese};
  static const std::vector<Index> kBoldChain = {kSansBold, kSymbolsBold, kSymbols, kChinese};
  static const std::vector<Index> kMonoChain = {kMono, kSans, kSymbols, kChinese};
  if (face == Face::kBold) return kBoldChain;
  return face == Face::kMono ? kMonoChain : kRegularChain;
}

// The first font of the chain that has the character; loads fonts on the way.
PdfFont* PdfFonts::FontFor(HPDF_Doc document, Face face, char32_t point) {
  if (IsMeaningless(point)) return nullptr;
  for (const Index index : FallbackChain(face)) {
    PdfFont& font = fonts_[index];
    if (font.path.empty()) continue;
    if (!font.loaded() && !LoadFont(document, font)) return nullptr;
    if (font.GlyphOf(point) != 0) return &font;
  }
  return nullptr;
}

std::vector<PdfFonts::Run> PdfFonts::Runs(HPDF_Doc document, Face face, const std::string& text,
                                          bool& ok) {
  std::vector<Run> runs;
  for (const char32_t point : DrawablePoints(text)) {
    if (!ok) return {};
    if (PdfFont* font = FontFor(document, face, point)) {
      AppendRun(runs, font, point);
      continue;
    }
    for (const char letter : "[" + CodePointName(point) + "]") {
      PdfFont* font = FontFor(document, face, static_cast<char32_t>(letter));
      ok = ok && font != nullptr;
      if (font) AppendRun(runs, font, static_cast<char32_t>(letter));
    }
  }
  return runs;
}

bool PdfFonts::Finish(PdfObjects& objects, bool with_cid_set) {
  for (PdfFont& font : fonts_)
    if (!FinishFont(objects, font, with_cid_set)) return false;
  return true;
}

}  // namespace telestrain
