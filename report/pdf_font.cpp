#include "report/pdf_font.h"

#include <algorithm>
#include <cstdio>

#include "report/unicode_text.h"

namespace telestrain {
namespace {

static_assert(HPDF_VERSION_ID == 20300, "the corrections below are made for libharu 2.3.0");

// Bits of a component record of a composite glyph (OpenType specification, table 'glyf').
constexpr unsigned kArgumentsAreWords = 0x0001, kHasScale = 0x0008, kMoreComponents = 0x0020,
                   kHasTwoScales = 0x0040, kHasMatrix = 0x0080;
constexpr std::size_t kGlyphHeaderBytes = 10;

unsigned BigEndian16(const std::string& bytes, std::size_t at) {
  return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])) << 8 |
         static_cast<unsigned char>(bytes[at + 1]);
}

std::string GlyphBytes(HPDF_TTFontDefAttr file, unsigned glyph) {
  const unsigned unit = file->header.index_to_loc_format == 0 ? 2 : 1;
  const unsigned begin = file->glyph_tbl.offsets[glyph] * unit;
  const unsigned end = file->glyph_tbl.offsets[glyph + 1] * unit;
  if (end <= begin + kGlyphHeaderBytes) return {};
  std::string bytes(end - begin, '\0');
  HPDF_UINT size = end - begin;
  HPDF_Stream_Seek(file->stream, static_cast<HPDF_INT>(begin + file->glyph_tbl.base_offset),
                   HPDF_SEEK_SET);
  HPDF_Stream_Read(file->stream, reinterpret_cast<HPDF_BYTE*>(bytes.data()), &size);
  bytes.resize(size);
  return bytes;
}

// The glyphs that a composite glyph is put together from.
std::vector<unsigned> Components(const std::string& glyph) {
  std::vector<unsigned> components;
  const bool composite = glyph.size() > kGlyphHeaderBytes && (glyph[0] & 0x80) != 0;
  std::size_t at = kGlyphHeaderBytes;
  while (composite && at + 4 <= glyph.size()) {
    const unsigned flags = BigEndian16(glyph, at);
    components.push_back(BigEndian16(glyph, at + 2));
    at += 4 + ((flags & kArgumentsAreWords) ? 4 : 2);
    if (flags & kHasScale) at += 2;
    if (flags & kHasTwoScales) at += 4;
    if (flags & kHasMatrix) at += 8;
    if (!(flags & kMoreComponents)) break;
  }
  return components;
}

void MarkComponents(HPDF_FontDef definition) {
  auto* file = static_cast<HPDF_TTFontDefAttr>(definition->attr);
  std::vector<unsigned> open;
  for (unsigned glyph = 0; glyph < file->num_glyphs; ++glyph)
    if (file->glyph_tbl.flgs[glyph]) open.push_back(glyph);
  while (!open.empty()) {
    const unsigned glyph = open.back();
    open.pop_back();
    for (const unsigned component : Components(GlyphBytes(file, glyph))) {
      if (component >= file->num_glyphs || file->glyph_tbl.flgs[component]) continue;
      file->glyph_tbl.flgs[component] = 1;
      open.push_back(component);
    }
  }
}

// The code of a character is its code point, so the map is the identity over the used ones.
std::string ToUnicodeMap(const std::set<HPDF_UINT16>& used) {
  std::string map =
      "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n"
      "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n"
      "/CMapName /Adobe-Identity-UCS def\n/CMapType 2 def\n"
      "1 begincodespacerange\n<0000> <FFFF>\nendcodespacerange\n";
  constexpr std::size_t kMostPerSection = 100;  // PDF 32000-1, 9.10.3
  const std::vector<HPDF_UINT16> points(used.begin(), used.end());
  for (std::size_t i = 0; i < points.size(); i += kMostPerSection) {
    const std::size_t end = std::min(points.size(), i + kMostPerSection);
    map += std::to_string(end - i) + " beginbfchar\n";
    for (std::size_t k = i; k < end; ++k) {
      char line[32];
      std::snprintf(line, sizeof line, "<%04X> <%04X>\n", points[k], points[k]);
      map += line;
    }
    map += "endbfchar\n";
  }
  return map + "endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n";
}

bool ReplaceStream(HPDF_Dict dictionary, const std::string& bytes) {
  HPDF_MemStream_FreeData(dictionary->stream);
  return HPDF_Stream_Write(dictionary->stream, reinterpret_cast<const HPDF_BYTE*>(bytes.data()),
                           static_cast<HPDF_UINT>(bytes.size())) == HPDF_OK;
}

// /W and the CIDToGIDMap cover the whole font otherwise: 340 kB for a Chinese one.
bool KeepUsedWidths(PdfObjects& objects, PdfFont& font, HPDF_FontAttr attributes) {
  HPDF_Array widths = objects.MakeArray();
  std::string glyph_of_code(2 * (std::size_t{*font.used.rbegin()} + 1), '\0');
  for (const HPDF_UINT16 point : font.used) {
    const unsigned glyph = font.GlyphOf(point);
    glyph_of_code[2 * std::size_t{point}] = static_cast<char>(glyph >> 8);
    glyph_of_code[2 * std::size_t{point} + 1] = static_cast<char>(glyph & 0xFF);
    HPDF_Array one = objects.MakeArray();
    objects.AppendNumber(one, static_cast<int>(font.Advance(point)));
    objects.AppendNumber(widths, point);
    objects.Append(widths, one);
  }
  objects.Set(attributes->descendant_font, "W", widths);
  return ReplaceStream(attributes->map_stream, glyph_of_code);
}

// A bit per character code, 0 (the missing glyph) included; PDF 32000-1, table 124.
std::string CidSet(const std::set<HPDF_UINT16>& used) {
  std::string bits(std::size_t{*used.rbegin()} / 8 + 1, '\0');
  const auto set = [&](unsigned cid) {
    bits[cid / 8] = static_cast<char>(static_cast<unsigned char>(bits[cid / 8]) | 0x80u >> cid % 8);
  };
  set(0);
  for (const HPDF_UINT16 cid : used) set(cid);
  return bits;
}

// libharu makes the descriptor when it writes the font; here it is made before, to be completed.
bool CompleteDescriptor(PdfObjects& objects, const PdfFont& font, bool with_cid_set) {
  HPDF_FontDef definition = font.definition();
  if (font.font->before_write_fn(font.font) != HPDF_OK || !definition->descriptor) return false;
  font.font->before_write_fn = nullptr;
  const int height = definition->cap_height > 0 ? definition->cap_height : definition->ascent;
  objects.SetNumber(definition->descriptor, "CapHeight", height);
  if (with_cid_set)
    objects.Set(definition->descriptor, "CIDSet", objects.MakeStream(CidSet(font.used), true));
  return objects.ok();
}

}  // namespace

HPDF_UINT16 PdfFont::GlyphOf(char32_t code_point) const {
  if (code_point > 0xFFFF) return 0;  // libharu addresses the basic plane only
  return HPDF_TTFontDef_GetGlyphid(definition(), static_cast<HPDF_UINT16>(code_point));
}

double PdfFont::Advance(char32_t code_point) const {
  return HPDF_TTFontDef_GetGidWidth(definition(), GlyphOf(code_point));
}

PdfFont FindFont(const std::vector<std::string>& candidates, int collection_index,
                 const std::string& package, bool required) {
  PdfFont font;
  font.collection_index = collection_index;
  font.package = package;
  font.required = required;
  for (const std::string& candidate : candidates) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(candidate, code)) continue;
    font.path = candidate;
    break;
  }
  return font;
}

bool LoadFont(HPDF_Doc document, PdfFont& font) {
  const std::string path = font.path.string();
  const char* name =
      font.collection_index < 0
          ? HPDF_LoadTTFontFromFile(document, path.c_str(), HPDF_TRUE)
          : HPDF_LoadTTFontFromFile2(document, path.c_str(),
                                     static_cast<HPDF_UINT>(font.collection_index), HPDF_TRUE);
  if (name) font.font = HPDF_GetFont(document, name, "UTF-8");
  return font.font != nullptr;
}

bool FinishFont(PdfObjects& objects, PdfFont& font, bool with_cid_set) {
  if (!font.loaded()) return true;
  font.used.insert(HPDF_UINT16{32});  // a font that was only asked for a glyph stays well-formed
  auto* attributes = static_cast<HPDF_FontAttr>(font.font->attr);
  MarkComponents(attributes->fontdef);
  objects.SetName(attributes->cmap_stream, "CMapName", "Adobe-Identity-UCS");
  return ReplaceStream(attributes->cmap_stream, ToUnicodeMap(font.used)) &&
         KeepUsedWidths(objects, font, attributes) &&
         CompleteDescriptor(objects, font, with_cid_set);
}

}  // namespace telestrain
