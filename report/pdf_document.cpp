#include "report/pdf_document.h"

#include <hpdf_objects.h>
#include <hpdf_pages.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "base/files.h"
#include "report/pdf_font.h"
#include "report/unicode_text.h"

namespace telestrain {
namespace {

constexpr const char* kFolder = "/usr/share/fonts/truetype/";
constexpr double kDegree_rad = 0.017453292519943295;

PdfFont Liberation(const std::string& file) {
  const std::string folder = kFolder;
  return FindFont({folder + "liberation2/" + file, folder + "liberation/" + file}, -1,
                  "fonts-liberation2", true);
}

PdfFont DejaVu(const std::string& file) {
  return FindFont({std::string(kFolder) + "dejavu/" + file}, -1, "fonts-dejavu-core", true);
}

enum FontIndex { kSans, kSansBold, kMono, kSymbols, kSymbolsBold, kChinese, kFontCount };

std::array<PdfFont, kFontCount> FindFonts() {
  return {Liberation("LiberationSans-Regular.ttf"),
          Liberation("LiberationSans-Bold.ttf"),
          Liberation("LiberationMono-Regular.ttf"),
          DejaVu("DejaVuSans.ttf"),
          DejaVu("DejaVuSans-Bold.ttf"),
          FindFont({std::string(kFolder) + "wqy/wqy-zenhei.ttc"}, 0, "fonts-wqy-zenhei", false)};
}

const std::vector<FontIndex>& FallbackChain(Face face) {
  static const std::vector<FontIndex> kRegularChain = {kSans, kSymbols, kChinese};
  static const std::vector<FontIndex> kBoldChain = {kSansBold, kSymbolsBold, kSymbols, kChinese};
  static const std::vector<FontIndex> kMonoChain = {kMono, kSans, kSymbols, kChinese};
  if (face == Face::kBold) return kBoldChain;
  return face == Face::kMono ? kMonoChain : kRegularChain;
}

// Code points to draw: control characters become spaces.
std::vector<char32_t> DrawablePoints(const std::string& text) {
  std::vector<char32_t> points = CodePoints(text);
  for (char32_t& point : points)
    if (point < 0x20 || (point >= 0x7F && point < 0xA0)) point = U' ';
  return points;
}

float F(double value) { return static_cast<float>(value); }

}  // namespace

struct PdfDocument::Internals {
  struct Run {  // characters of one font
    PdfFont* font;
    std::string utf8;
    double advance = 0;  // thousandths of the font size
  };

  HPDF_Doc document = nullptr;
  HPDF_Encoder utf8 = nullptr;
  std::array<PdfFont, kFontCount> fonts = FindFonts();
  std::vector<HPDF_Page> pages;
  HPDF_Page page = nullptr;
  HPDF_Outline chapter = nullptr;
  HPDF_STATUS error = HPDF_OK;
  HPDF_STATUS error_detail = 0;

  ~Internals() {
    if (document) HPDF_Free(document);
  }
  bool ok() const { return error == HPDF_OK; }
  // libharu's handler: keeps the first error; nothing is thrown through its C frames.
  static void Record(HPDF_STATUS error_code, HPDF_STATUS detail, void* self) {
    auto& internals = *static_cast<Internals*>(self);
    if (!internals.ok()) return;
    internals.error = error_code;
    internals.error_detail = detail;
  }
  void Require(bool done) {
    if (!done && ok()) error = HPDF_FAILD_TO_ALLOC_MEM;
  }
  Error ErrorOfLibharu() const {
    char text[120];
    std::snprintf(text, sizeof text, "the PDF library failed with error 0x%04lX, detail %lu", error,
                  error_detail);
    return OutputFailed(std::string(text) + "; free memory, or report it with the results folder");
  }

  PdfFont* FontFor(Face face, char32_t point);
  std::vector<Run> Runs(Face face, const std::string& text);
  void AppendRun(std::vector<Run>& runs, PdfFont* font, char32_t point) const;
  void SetFill(Color color) {
    HPDF_Page_SetRGBFill(page, F(color.red), F(color.green), F(color.blue));
  }
  void SetStroke(const Stroke& stroke);
  void MovePath(const std::vector<PagePoint>& points);
  void AddTrailerId(const std::string& seed);
  void SetInfo(const PdfInfo& info);
};

// The first font of the chain that has the character; loads fonts on the way.
PdfFont* PdfDocument::Internals::FontFor(Face face, char32_t point) {
  for (const FontIndex index : FallbackChain(face)) {
    PdfFont& font = fonts[index];
    if (font.path.empty()) continue;
    if (!font.loaded() && !LoadFont(document, font)) return nullptr;
    if (point == U' ' || font.GlyphOf(point) != 0) return &font;
  }
  return nullptr;
}

void PdfDocument::Internals::AppendRun(std::vector<Run>& runs, PdfFont* font,
                                       char32_t point) const {
  if (runs.empty() || runs.back().font != font) runs.push_back({font, "", 0});
  runs.back().utf8 += Utf8(point);
  runs.back().advance += font->Advance(point);
  font->used.insert(static_cast<HPDF_UINT16>(point));
}

std::vector<PdfDocument::Internals::Run> PdfDocument::Internals::Runs(Face face,
                                                                      const std::string& text) {
  std::vector<Run> runs;
  for (const char32_t point : DrawablePoints(text)) {
    if (!ok()) return {};
    if (PdfFont* font = FontFor(face, point)) {
      AppendRun(runs, font, point);
      continue;
    }
    std::string name = CodePointName(point);
    name.insert(name.begin(), '[');
    name.push_back(']');
    for (const char letter : name) {
      PdfFont* font = FontFor(face, static_cast<char32_t>(letter));
      Require(font != nullptr);
      if (font) AppendRun(runs, font, static_cast<char32_t>(letter));
    }
  }
  return runs;
}

void PdfDocument::Internals::SetStroke(const Stroke& stroke) {
  static const std::map<Dash, std::vector<HPDF_UINT16>> kPatterns = {{Dash::kSolid, {}},
                                                                     {Dash::kDashed, {4, 3}},
                                                                     {Dash::kDotted, {1, 2}},
                                                                     {Dash::kDashDot, {6, 2, 1, 2}},
                                                                     {Dash::kLong, {9, 3}}};
  HPDF_Page_SetRGBStroke(page, F(stroke.color.red), F(stroke.color.green), F(stroke.color.blue));
  HPDF_Page_SetLineWidth(page, F(stroke.width_pt));
  HPDF_Page_SetLineJoin(page, HPDF_ROUND_JOIN);
  const auto& pattern = kPatterns.at(stroke.dash);
  HPDF_Page_SetDash(page, pattern.empty() ? nullptr : pattern.data(),
                    static_cast<HPDF_UINT>(pattern.size()), 0);
}

void PdfDocument::Internals::MovePath(const std::vector<PagePoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float x = F(points[i].x_pt), y = F(points[i].y_pt);
    if (i == 0)
      HPDF_Page_MoveTo(page, x, y);
    else
      HPDF_Page_LineTo(page, x, y);
  }
}

// libharu writes no /ID without encryption, and with it one made of the time.
void PdfDocument::Internals::AddTrailerId(const std::string& seed) {
  const std::string hash = Sha256Hex(seed).substr(0, 16);
  HPDF_Array id = HPDF_Array_New(document->mmgr);
  for (int i = 0; i < 2; ++i) {
    const auto* bytes = reinterpret_cast<const HPDF_BYTE*>(hash.data());
    HPDF_Binary half = HPDF_Binary_New(document->mmgr, const_cast<HPDF_BYTE*>(bytes),
                                       static_cast<HPDF_UINT>(hash.size()));
    Require(HPDF_Array_Add(id, half) == HPDF_OK);
  }
  Require(HPDF_Dict_Add(document->trailer, "ID", id) == HPDF_OK);
}

void PdfDocument::Internals::SetInfo(const PdfInfo& info) {
  const auto set = [this](HPDF_InfoType type, const std::string& text) {
    if (!text.empty()) HPDF_SetInfoAttr(document, type, text.c_str());
  };
  // The UTF-8 encoder makes UTF-16 of the information texts.
  document->cur_encoder = utf8;
  set(HPDF_INFO_TITLE, info.title);
  set(HPDF_INFO_AUTHOR, info.author);
  set(HPDF_INFO_SUBJECT, info.subject);
  set(HPDF_INFO_CREATOR, info.creator);
  if (info.created.empty()) return;
  HPDF_String date = HPDF_String_New(document->mmgr, info.created.c_str(), nullptr);
  Require(HPDF_Dict_Add(document->info, "CreationDate", date) == HPDF_OK);
}

PdfDocument::PdfDocument() : internals_(std::make_unique<Internals>()) {}
PdfDocument::~PdfDocument() = default;

Result<std::unique_ptr<PdfDocument>> PdfDocument::Create(ArchiveLevel) {
  std::unique_ptr<PdfDocument> pdf(new PdfDocument);
  Internals& in = *pdf->internals_;
  for (const PdfFont& font : in.fonts)
    if (font.required && font.path.empty())
      return OutputFailed("a font of the report is not installed under " + std::string(kFolder) +
                          "; install the package " + font.package);
  in.document = HPDF_New(&Internals::Record, &in);
  if (!in.document) return OutputFailed("the PDF library cannot start; free memory");
  HPDF_SetCompressionMode(in.document, HPDF_COMP_ALL);
  HPDF_UseUTFEncodings(in.document);
  in.utf8 = HPDF_GetEncoder(in.document, "UTF-8");
  HPDF_SetPageMode(in.document, HPDF_PAGE_MODE_USE_OUTLINE);
  if (!in.ok()) return in.ErrorOfLibharu();
  return pdf;
}

int PdfDocument::AddPage() {
  Internals& in = *internals_;
  if (!in.ok()) return 0;
  HPDF_Page page = HPDF_AddPage(in.document);
  if (!page) return 0;
  HPDF_Page_SetSize(page, HPDF_PAGE_SIZE_A4, HPDF_PAGE_PORTRAIT);
  in.pages.push_back(page);
  in.page = page;
  return static_cast<int>(in.pages.size()) - 1;
}

void PdfDocument::SelectPage(int index) {
  internals_->page = internals_->pages[static_cast<std::size_t>(index)];
}

int PdfDocument::PageCount() const { return static_cast<int>(internals_->pages.size()); }

double PdfDocument::TextWidth_pt(const TextStyle& style, const std::string& text) {
  double advance = 0;
  for (const auto& run : internals_->Runs(style.face, text)) advance += run.advance;
  return advance * style.size_pt / 1000;
}

void PdfDocument::DrawText(const TextStyle& style, PagePoint at, const std::string& text,
                           Align align, double rotation_deg) {
  Internals& in = *internals_;
  const auto runs = in.Runs(style.face, text);
  if (!in.ok() || runs.empty()) return;
  const double share = align == Align::kLeft ? 0 : align == Align::kCenter ? 0.5 : 1;
  const double shift_pt = share > 0 ? share * TextWidth_pt(style, text) : 0;
  const double c = std::cos(rotation_deg * kDegree_rad), s = std::sin(rotation_deg * kDegree_rad);
  in.SetFill(style.color);
  HPDF_Page_BeginText(in.page);
  HPDF_Page_SetTextMatrix(in.page, F(c), F(s), F(-s), F(c), F(at.x_pt - c * shift_pt),
                          F(at.y_pt - s * shift_pt));
  for (const auto& run : runs) {
    HPDF_Page_SetFontAndSize(in.page, run.font->font, F(style.size_pt));
    HPDF_Page_ShowText(in.page, run.utf8.c_str());
  }
  HPDF_Page_EndText(in.page);
}

void PdfDocument::FillBox(const PageBox& box, Color color) {
  Internals& in = *internals_;
  if (!in.ok()) return;
  in.SetFill(color);
  HPDF_Page_Rectangle(in.page, F(box.left_pt), F(box.bottom_pt), F(box.width_pt), F(box.height_pt));
  HPDF_Page_Fill(in.page);
}

void PdfDocument::StrokeBox(const PageBox& box, const Stroke& stroke) {
  Internals& in = *internals_;
  if (!in.ok()) return;
  in.SetStroke(stroke);
  HPDF_Page_Rectangle(in.page, F(box.left_pt), F(box.bottom_pt), F(box.width_pt), F(box.height_pt));
  HPDF_Page_Stroke(in.page);
}

void PdfDocument::DrawPolyline(const std::vector<PagePoint>& points, const Stroke& stroke) {
  Internals& in = *internals_;
  if (!in.ok() || points.size() < 2) return;
  in.SetStroke(stroke);
  in.MovePath(points);
  HPDF_Page_Stroke(in.page);
}

void PdfDocument::FillPolygon(const std::vector<PagePoint>& points, Color color) {
  Internals& in = *internals_;
  if (!in.ok() || points.size() < 3) return;
  in.SetFill(color);
  in.MovePath(points);
  HPDF_Page_ClosePath(in.page);
  HPDF_Page_Fill(in.page);
}

void PdfDocument::FillCircle(PagePoint center, double radius_pt, Color color) {
  Internals& in = *internals_;
  if (!in.ok()) return;
  in.SetFill(color);
  HPDF_Page_Circle(in.page, F(center.x_pt), F(center.y_pt), F(radius_pt));
  HPDF_Page_Fill(in.page);
}

void PdfDocument::BeginClip(const PageBox& box) {
  Internals& in = *internals_;
  if (!in.ok()) return;
  HPDF_Page_GSave(in.page);
  HPDF_Page_Rectangle(in.page, F(box.left_pt), F(box.bottom_pt), F(box.width_pt), F(box.height_pt));
  HPDF_Page_Clip(in.page);
  HPDF_Page_EndPath(in.page);
}

void PdfDocument::EndClip() {
  if (internals_->ok()) HPDF_Page_GRestore(internals_->page);
}

void PdfDocument::DrawImage(const RgbImage& image, const PageBox& box) {
  Internals& in = *internals_;
  if (!in.ok()) return;
  HPDF_Image object = HPDF_LoadRawImageFromMem(
      in.document, image.pixels.data(), static_cast<HPDF_UINT>(image.width_px),
      static_cast<HPDF_UINT>(image.height_px), HPDF_CS_DEVICE_RGB, 8);
  if (!object) return;
  const std::string rows = PredictRows(image);
  HPDF_MemStream_FreeData(object->stream);
  in.Require(HPDF_Stream_Write(object->stream, reinterpret_cast<const HPDF_BYTE*>(rows.data()),
                               static_cast<HPDF_UINT>(rows.size())) == HPDF_OK);
  HPDF_Dict parameters = HPDF_Dict_New(in.document->mmgr);
  HPDF_Dict_AddNumber(parameters, "Predictor", 15);
  HPDF_Dict_AddNumber(parameters, "Colors", 3);
  HPDF_Dict_AddNumber(parameters, "BitsPerComponent", 8);
  HPDF_Dict_AddNumber(parameters, "Columns", image.width_px);
  object->filterParams = parameters;
  HPDF_Page_DrawImage(in.page, object, F(box.left_pt), F(box.bottom_pt), F(box.width_pt),
                      F(box.height_pt));
}

void PdfDocument::AddBookmark(const std::string& title, int level, double top_pt) {
  Internals& in = *internals_;
  if (!in.ok()) return;
  HPDF_Outline parent = level > 1 ? in.chapter : nullptr;
  HPDF_Outline entry = HPDF_CreateOutline(in.document, parent, title.c_str(), in.utf8);
  if (!entry) return;
  // Written by hand: libharu's destinations force a zoom factor upon the reader.
  HPDF_Array target = HPDF_Array_New(in.document->mmgr);
  const bool done = HPDF_Array_Add(target, in.page) == HPDF_OK &&
                    HPDF_Array_AddName(target, "XYZ") == HPDF_OK &&
                    HPDF_Array_Add(target, HPDF_Null_New(in.document->mmgr)) == HPDF_OK &&
                    HPDF_Array_AddReal(target, F(top_pt)) == HPDF_OK &&
                    HPDF_Array_Add(target, HPDF_Null_New(in.document->mmgr)) == HPDF_OK &&
                    HPDF_Dict_Add(entry, "Dest", target) == HPDF_OK;
  in.Require(done);
  if (level <= 1) in.chapter = entry;
}

Result<std::string> PdfDocument::Save(const PdfInfo& info, const std::string& id_seed) {
  Internals& in = *internals_;
  in.SetInfo(info);
  in.AddTrailerId(id_seed);
  for (PdfFont& font : in.fonts) in.Require(FinishFont(in.document, font));
  if (!in.ok()) return in.ErrorOfLibharu();
  HPDF_SaveToStream(in.document);
  if (!in.ok()) return in.ErrorOfLibharu();
  HPDF_ResetStream(in.document);
  std::string bytes;
  std::vector<HPDF_BYTE> buffer(1 << 16);
  for (;;) {
    auto size = static_cast<HPDF_UINT32>(buffer.size());
    const HPDF_STATUS status = HPDF_ReadFromStream(in.document, buffer.data(), &size);
    bytes.append(reinterpret_cast<const char*>(buffer.data()), size);
    if (status == HPDF_STREAM_EOF || size == 0) return bytes;
    if (status != HPDF_OK) return in.ErrorOfLibharu();
  }
}

}  // namespace telestrain
