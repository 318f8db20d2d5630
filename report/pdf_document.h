#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "report/page_geometry.h"
#include "report/rgb_image.h"

namespace telestrain {

// What the document says about itself. `created` is a PDF date ("D:20260101120000Z") or empty.
struct PdfInfo {
  std::string title, author, subject, creator;
  std::string created;
};

// A PDF of A4 pages drawn with libharu; hpdf.h stays in the .cpp. Text is UTF-8 in embedded
// TrueType fonts: Liberation, then DejaVu, then WenQuanYi for a character the one before lacks. A
// character that none has is drawn as its name, "[U+1F600]", never left out.
// Drawing cannot fail call by call: the first error stays, later calls do nothing, `Save` reports
// it. One document belongs to one thread.
class PdfDocument {
 public:
  // Fails (kOutputFailed) when a required font is not installed.
  static Result<std::unique_ptr<PdfDocument>> Create();
  ~PdfDocument();
  PdfDocument(const PdfDocument&) = delete;
  PdfDocument& operator=(const PdfDocument&) = delete;

  int AddPage();  // and draws on it from now on; returns its index from 0
  void SelectPage(int index);
  int PageCount() const;

  double TextWidth_pt(const TextStyle& style, const std::string& text);
  // `at` is the base line's left end, centre or right end; `rotation_deg` is counter-clockwise.
  void DrawText(const TextStyle& style, PagePoint at, const std::string& text,
                Align align = Align::kLeft, double rotation_deg = 0);

  void FillBox(const PageBox& box, Color color);
  void StrokeBox(const PageBox& box, const Stroke& stroke);
  void DrawPolyline(const std::vector<PagePoint>& points, const Stroke& stroke);
  void DrawLine(PagePoint a, PagePoint b, const Stroke& stroke) { DrawPolyline({a, b}, stroke); }
  void FillPolygon(const std::vector<PagePoint>& points, Color color);
  void FillCircle(PagePoint center, double radius_pt, Color color);
  void BeginClip(const PageBox& box);
  void EndClip();

  void DrawImage(const RgbImage& image, const PageBox& box);
  // An entry of the outline, pointing at `top_pt` of the current page; `level` 1 or 2.
  void AddBookmark(const std::string& title, int level, double top_pt);

  // The bytes of the file. Its /ID is made of `id_seed`, so equal calls give equal bytes.
  Result<std::string> Save(const PdfInfo& info, const std::string& id_seed);

 private:
  struct Internals;
  PdfDocument();
  std::unique_ptr<Internals> internals_;
};

}  // namespace telestrain
