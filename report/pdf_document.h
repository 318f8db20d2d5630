#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "report/page_geometry.h"
#include "report/rgb_image.h"

namespace telestrain {

// What the document says about itself. `created` is a PDF date ("D:20260101120000Z") or empty;
// `language` an RFC 3066 tag ("en", "de", "zh").
struct PdfInfo {
  std::string title, author, subject, keywords, creator;
  std::string created;
  std::string language = "en";
};

// What the file conforms to. k3a is PDF/A-3a and PDF/UA-1: tagged, with attachments and signature
// fields. k1b is PDF/A-1b, of which free validators exist: the same pages without tags; attachments
// and signature fields are left out.
enum class ArchiveLevel { k3a, k1b };

// A piece of the page by its meaning, as PDF names it: "H1" "H2" "P" "Table" "TR" "TH" "TD"
// "Figure" "Caption" "L" "LI" "Lbl" "LBody" "Note" "Link" "Sect" "Span".
struct PdfTag {
  std::string type;
  std::string alternative_text = {};  // of a figure: what it shows; of a link: where it leads
  std::string scope = {};             // of a TH: "Column" or "Row"
  std::optional<PageBox> box = {};    // of a figure: where it is
};

// What decoration is: furniture of every page, or of the place where it stands.
enum class Decoration { kLayout, kPageHeader, kPageFooter };

// A file inside the file, PDF/A-3's associated file.
struct PdfAttachment {
  std::string name, media_type, description;
  std::string relationship = "Data";  // or "Source", "Supplement"
  std::string bytes;
};

// A PDF of A4 pages drawn with libharu; hpdf.h stays in the .cpp. Text is UTF-8 in embedded
// TrueType fonts: Liberation, then DejaVu, then WenQuanYi for a character the one before lacks. A
// character that none has is drawn as its name, "[U+1F600]", never left out.
// Drawing cannot fail call by call: the first error stays, later calls do nothing, `Save` reports
// it. One document belongs to one thread.
class PdfDocument {
 public:
  // Fails (kOutputFailed) when a required font is not installed.
  static Result<std::unique_ptr<PdfDocument>> Create(ArchiveLevel level = ArchiveLevel::k3a);
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

  // Compresses in threads of its own, two at most; drop or move the pixels if you can.
  void DrawImage(RgbImage image, const PageBox& box);

  // Everything drawn until the matching EndTag, on however many pages, is a piece of this meaning;
  // tags nest. What is drawn with no tag open, or directly in one that only groups others (Table,
  // TR, L, LI, Caption, Sect), is decoration that a reading aid skips. Pieces are read in the order
  // in which they began, not where they stand. Heading levels that a document skips are closed up;
  // a tag that nothing was drawn in is left out, cells of tables are not. Use ScopedTag.
  // Returns the number of the piece, for ResumeTag.
  int BeginTag(const PdfTag& tag);
  // Goes on with a piece that was ended before: a cell that is cut over two pages.
  void ResumeTag(int number);
  void EndTag();
  // Until the matching EndDecoration nothing is part of the open tag: repeated table headers,
  // lines.
  void BeginDecoration(Decoration kind = Decoration::kLayout);
  void EndDecoration();

  // A place that links can name; one that is named twice keeps its first place.
  void AddDestination(const std::string& name, double top_pt);
  // A link from `box` of the current page to a destination, which may be added later. It belongs
  // to the open tag, a "Link" whose alternative text says where it leads. A link to nowhere is left
  // out by Save.
  void AddLink(const PageBox& box, const std::string& destination);
  void Attach(PdfAttachment attachment);
  // An empty signature field of the current page, to be filled by `telestrain sign`. A second one
  // of the same name is left out.
  void AddSignatureField(const std::string& name, const std::string& tip, const PageBox& box);

  // An entry of the outline, pointing at `top_pt` of the current page; `level` 1 or 2.
  void AddBookmark(const std::string& title, int level, double top_pt);

  // The bytes of the file; to be called once. Its /ID is the hash of them and of `id_seed`, so
  // equal calls give equal bytes. An empty title becomes "Report".
  Result<std::string> Save(const PdfInfo& info, const std::string& id_seed);

 private:
  struct Internals;
  PdfDocument();
  std::unique_ptr<Internals> internals_;
};

class ScopedTag {
 public:
  ScopedTag(PdfDocument& pdf, const PdfTag& tag) : pdf_(pdf), number_(pdf.BeginTag(tag)) {}
  ScopedTag(PdfDocument& pdf, int resumed) : pdf_(pdf), number_(resumed) {
    pdf_.ResumeTag(resumed);
  }
  ~ScopedTag() { pdf_.EndTag(); }
  ScopedTag(const ScopedTag&) = delete;
  ScopedTag& operator=(const ScopedTag&) = delete;
  int number() const { return number_; }

 private:
  PdfDocument& pdf_;
  int number_;
};

class ScopedDecoration {
 public:
  explicit ScopedDecoration(PdfDocument& pdf, Decoration kind = Decoration::kLayout) : pdf_(pdf) {
    pdf_.BeginDecoration(kind);
  }
  ~ScopedDecoration() { pdf_.EndDecoration(); }
  ScopedDecoration(const ScopedDecoration&) = delete;
  ScopedDecoration& operator=(const ScopedDecoration&) = delete;

 private:
  PdfDocument& pdf_;
};

}  // namespace telestrain
