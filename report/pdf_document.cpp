#include "report/pdf_document.h"

#include <hpdf_pages.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "base/files.h"
#include "report/pdf_annotations.h"
#include "report/pdf_attachments.h"
#include "report/pdf_image.h"
#include "report/pdf_metadata.h"
#include "report/pdf_structure.h"
#include "report/pdf_text.h"

namespace telestrain {
namespace {

constexpr double kDegree_rad = 0.017453292519943295;
constexpr const char* kColorProfile = "/usr/share/color/icc/sRGB.icc";

// What stands in the trailer until the hash of the file is known: as many hexadecimal digits.
constexpr std::size_t kIdBytes = 16;

float F(double value) { return static_cast<float>(value); }

// The first and the last identifier are the same: the file was never changed.
void ReplaceId(std::string& file, const std::string& hash) {
  const std::string digits(2 * kIdBytes, '0');
  std::size_t at = file.rfind("/ID");
  for (int half = 0; half < 2 && at != std::string::npos; ++half) {
    at = file.find(digits, at);
    if (at != std::string::npos) file.replace(at, digits.size(), hash, 0, digits.size());
  }
}

}  // namespace

struct PdfDocument::Internals {
  Internals(HPDF_Doc new_document, ArchiveLevel archive_level)
      : document(new_document),
        level(archive_level),
        objects(new_document),
        structure(objects, archive_level == ArchiveLevel::k3a),
        annotations(objects, structure),
        images(objects) {}
  ~Internals() { HPDF_Free(document); }

  HPDF_Doc document;
  ArchiveLevel level;
  PdfObjects objects;
  PdfStructure structure;
  PdfAnnotations annotations;
  PdfImages images;
  PdfFonts fonts;
  std::vector<PdfAttachment> attachments;
  std::string color_profile;
  std::vector<HPDF_Page> pages;
  HPDF_Page page = nullptr;
  HPDF_Outline chapter = nullptr;
  HPDF_STATUS error = HPDF_OK;
  HPDF_STATUS error_detail = 0;

  bool ok() const { return error == HPDF_OK && objects.ok(); }
  // Whether something can be drawn; what is drawn next belongs to the open tag.
  bool Ready() {
    if (!ok() || !page) return false;
    structure.Mark(page);
    return ok();
  }
  // libharu's handler: keeps the first error; nothing is thrown through its C frames.
  static void Record(HPDF_STATUS error_code, HPDF_STATUS detail, void* self) {
    auto& internals = *static_cast<Internals*>(self);
    if (internals.error != HPDF_OK) return;
    internals.error = error_code;
    internals.error_detail = detail;
  }
  Error ErrorOfLibharu() const {
    const HPDF_STATUS code = error == HPDF_OK ? HPDF_FAILD_TO_ALLOC_MEM : error;
    char text[120];
    std::snprintf(text, sizeof text, "the PDF library failed with error 0x%04lX, detail %lu", code,
                  error_detail);
    return OutputFailed(std::string(text) + "; free memory, or report it with the results folder");
  }

  std::vector<PdfFonts::Run> Runs(Face face, const std::string& text) {
    bool done = ok();
    auto runs = fonts.Runs(document, face, text, done);
    objects.Require(done);
    return runs;
  }
  void SetFill(Color color) {
    HPDF_Page_SetRGBFill(page, F(color.red), F(color.green), F(color.blue));
  }
  void SetStroke(const Stroke& stroke);
  void MovePath(const std::vector<PagePoint>& points);
  void AddBox(const PageBox& box) {
    HPDF_Page_Rectangle(page, F(box.left_pt), F(box.bottom_pt), F(box.width_pt), F(box.height_pt));
  }
  void AddEmptyId();
  void WriteCatalog(const PdfInfo& info);
  Result<std::string> Bytes();
};

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
void PdfDocument::Internals::AddEmptyId() {
  HPDF_Array id = objects.MakeArray();
  for (int i = 0; i < 2; ++i) objects.Append(id, objects.MakeBytes(std::string(kIdBytes, '\0')));
  objects.Set(document->trailer, "ID", id);
}

void PdfDocument::Internals::WriteCatalog(const PdfInfo& info) {
  images.Finish();
  structure.CloseMark();
  annotations.Write(document->catalog);
  structure.Write(document->catalog);
  WriteMetadata(objects, document, info, level);
  WriteOutputIntent(objects, document, color_profile);
  WriteAttachments(objects, document->catalog, std::move(attachments), info.created);
  if (objects.ok()) objects.Require(fonts.Finish(objects, level == ArchiveLevel::k1b));
  AddEmptyId();
  // Set last: other calls of libharu set it to what they need at least.
  document->pdf_version = level == ArchiveLevel::k1b ? HPDF_VER_14 : HPDF_VER_17;
}

Result<std::string> PdfDocument::Internals::Bytes() {
  HPDF_SaveToStream(document);
  if (!ok()) return ErrorOfLibharu();
  HPDF_ResetStream(document);
  std::string bytes;
  std::vector<HPDF_BYTE> buffer(1 << 16);
  for (;;) {
    auto size = static_cast<HPDF_UINT32>(buffer.size());
    const HPDF_STATUS status = HPDF_ReadFromStream(document, buffer.data(), &size);
    bytes.append(reinterpret_cast<const char*>(buffer.data()), size);
    if (status == HPDF_STREAM_EOF || size == 0) return bytes;
    if (status != HPDF_OK) return ErrorOfLibharu();
  }
}

PdfDocument::PdfDocument() = default;
PdfDocument::~PdfDocument() = default;

Result<std::unique_ptr<PdfDocument>> PdfDocument::Create(ArchiveLevel level) {
  TELESTRAIN_RETURN_IF_ERROR(PdfFonts().CheckInstalled());
  auto profile = ReadFile(kColorProfile, kMostTextBytes);
  if (!profile)
    return OutputFailed("the colour profile of the report cannot be read: " +
                        profile.error().message + "; install the package icc-profiles-free");
  HPDF_Doc document = HPDF_New(nullptr, nullptr);
  if (!document) return OutputFailed("the PDF library cannot start; free memory");
  std::unique_ptr<PdfDocument> pdf(new PdfDocument);
  pdf->internals_ = std::make_unique<Internals>(document, level);
  Internals& in = *pdf->internals_;
  in.color_profile = std::move(profile).value();
  HPDF_SetErrorHandler(document, &Internals::Record);
  document->error.user_data = &in;
  HPDF_SetCompressionMode(document, HPDF_COMP_ALL);
  HPDF_UseUTFEncodings(document);
  HPDF_SetPageMode(document, HPDF_PAGE_MODE_USE_OUTLINE);
  if (!in.ok()) return in.ErrorOfLibharu();
  return pdf;
}

int PdfDocument::AddPage() {
  Internals& in = *internals_;
  if (!in.ok()) return 0;
  HPDF_Page page = HPDF_AddPage(in.document);
  if (!page) return 0;
  HPDF_Page_SetSize(page, HPDF_PAGE_SIZE_A4, HPDF_PAGE_PORTRAIT);
  in.structure.CloseMark();
  in.structure.AddPage(page);
  in.objects.SetName(page, "Tabs", "S");  // reading order is also the order of links and fields
  in.pages.push_back(page);
  in.page = page;
  return static_cast<int>(in.pages.size()) - 1;
}

void PdfDocument::SelectPage(int index) {
  internals_->structure.CloseMark();
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
  if (runs.empty() || !in.Ready()) return;
  const double share = align == Align::kLeft ? 0 : align == Align::kCenter ? 0.5 : 1;
  // The space that a wrapped line ends with does not move it.
  const std::string seen = text.substr(0, text.find_last_not_of(' ') + 1);
  const double shift_pt = share > 0 ? share * TextWidth_pt(style, seen) : 0;
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
  if (!in.Ready()) return;
  in.SetFill(color);
  in.AddBox(box);
  HPDF_Page_Fill(in.page);
}

void PdfDocument::StrokeBox(const PageBox& box, const Stroke& stroke) {
  Internals& in = *internals_;
  if (!in.Ready()) return;
  in.SetStroke(stroke);
  in.AddBox(box);
  HPDF_Page_Stroke(in.page);
}

void PdfDocument::DrawPolyline(const std::vector<PagePoint>& points, const Stroke& stroke) {
  Internals& in = *internals_;
  if (points.size() < 2 || !in.Ready()) return;
  in.SetStroke(stroke);
  in.MovePath(points);
  HPDF_Page_Stroke(in.page);
}

void PdfDocument::FillPolygon(const std::vector<PagePoint>& points, Color color) {
  Internals& in = *internals_;
  if (points.size() < 3 || !in.Ready()) return;
  in.SetFill(color);
  in.MovePath(points);
  HPDF_Page_ClosePath(in.page);
  HPDF_Page_Fill(in.page);
}

void PdfDocument::FillCircle(PagePoint center, double radius_pt, Color color) {
  Internals& in = *internals_;
  if (!in.Ready()) return;
  in.SetFill(color);
  HPDF_Page_Circle(in.page, F(center.x_pt), F(center.y_pt), F(radius_pt));
  HPDF_Page_Fill(in.page);
}

void PdfDocument::BeginClip(const PageBox& box) {
  Internals& in = *internals_;
  if (!in.Ready()) return;
  HPDF_Page_GSave(in.page);
  in.AddBox(box);
  HPDF_Page_Clip(in.page);
  HPDF_Page_EndPath(in.page);
}

void PdfDocument::EndClip() {
  if (internals_->ok()) HPDF_Page_GRestore(internals_->page);
}

void PdfDocument::DrawImage(RgbImage image, const PageBox& box) {
  Internals& in = *internals_;
  if (!in.Ready()) return;
  HPDF_Dict object = in.images.Add(std::move(image));
  if (!in.ok()) return;
  HPDF_Page_DrawImage(in.page, object, F(box.left_pt), F(box.bottom_pt), F(box.width_pt),
                      F(box.height_pt));
}

int PdfDocument::BeginTag(const PdfTag& tag) { return internals_->structure.Begin(tag); }
void PdfDocument::ResumeTag(int number) { internals_->structure.Resume(number); }
void PdfDocument::EndTag() { internals_->structure.End(); }
void PdfDocument::BeginDecoration(Decoration kind) { internals_->structure.BeginDecoration(kind); }
void PdfDocument::EndDecoration() { internals_->structure.EndDecoration(); }

void PdfDocument::AddDestination(const std::string& name, double top_pt) {
  if (internals_->page) internals_->annotations.AddDestination(name, internals_->page, top_pt);
}

void PdfDocument::AddLink(const PageBox& box, const std::string& destination) {
  if (internals_->page) internals_->annotations.AddLink(box, destination, internals_->page);
}

void PdfDocument::Attach(PdfAttachment attachment) {
  if (internals_->level == ArchiveLevel::k3a)
    internals_->attachments.push_back(std::move(attachment));
}

void PdfDocument::AddSignatureField(const std::string& name, const std::string& tip,
                                    const PageBox& box) {
  if (internals_->page && internals_->level == ArchiveLevel::k3a)
    internals_->annotations.AddSignatureField(name, tip, box, internals_->page);
}

void PdfDocument::AddBookmark(const std::string& title, int level, double top_pt) {
  Internals& in = *internals_;
  if (!in.ok() || !in.page) return;
  HPDF_Outline parent = level > 1 ? in.chapter : nullptr;
  HPDF_Outline entry = HPDF_CreateOutline(in.document, parent, "", nullptr);
  if (!entry) return;
  in.objects.SetText(entry, "Title", title);
  in.objects.Set(entry, "Dest", in.objects.MakeDestination(in.page, top_pt));
  if (level <= 1) in.chapter = entry;
}

Result<std::string> PdfDocument::Save(const PdfInfo& info, const std::string& id_seed) {
  Internals& in = *internals_;
  if (!in.ok()) return in.ErrorOfLibharu();
  in.WriteCatalog(CleanInfo(info));
  if (!in.ok()) return in.ErrorOfLibharu();
  TELESTRAIN_ASSIGN_OR_RETURN(std::string bytes, in.Bytes());
  ReplaceId(bytes, Sha256Hex(Sha256Hex(bytes) + id_seed));
  return bytes;
}

}  // namespace telestrain
