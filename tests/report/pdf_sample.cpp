#include "pdf_sample.h"

#include <stdexcept>

namespace telestrain {
namespace {

const TextStyle kText{Face::kRegular, 10, {}};

void DrawTagged(PdfDocument& pdf, const PdfTag& tag, PagePoint at, const std::string& text) {
  const ScopedTag piece(pdf, tag);
  pdf.DrawText(kText, at, text);
}

// Two rows of two cells and a header; the last cell goes on on the next page.
void DrawTable(PdfDocument& pdf) {
  const ScopedTag table(pdf, PdfTag{"Table"});
  {
    const ScopedTag caption(pdf, PdfTag{"Caption"});
    DrawTagged(pdf, {"P"}, {60, 560}, "Caption of the table");
  }
  pdf.FillBox({60, 538, 300, 16}, ColorOf(0xD3DAE1));
  {
    const ScopedTag row(pdf, PdfTag{"TR"});
    DrawTagged(pdf, {"TH", "", "Column"}, {60, 540}, "Quantity");
    DrawTagged(pdf, {"TH", "", "Column"}, {200, 540}, "Value");
  }
  int last = 0;
  for (const char* name : {"Length", "Strain"}) {
    const double y_pt = name[0] == 'L' ? 520 : 500;
    const ScopedTag row(pdf, PdfTag{"TR"});
    DrawTagged(pdf, {"TH", "", "Row"}, {60, y_pt}, name);
    const ScopedTag cell(pdf, PdfTag{"TD"});
    last = cell.number();
    if (name[0] == 'S') pdf.DrawText(kText, {200, y_pt}, "first half");
  }
  pdf.AddPage();
  {
    const ScopedDecoration repeated(pdf);
    pdf.DrawText(kText, {60, 780}, "Quantity (repeated)");
  }
  const ScopedTag resumed(pdf, last);
  pdf.DrawText(kText, {200, 760}, "second half");
}

void DrawFigure(PdfDocument& pdf) {
  const PageBox box{60, 300, 200, 100};
  const ScopedTag figure(pdf, PdfTag{"Figure", "A curve, a picture and µε 曲线", "", box});
  pdf.StrokeBox(box, {{}, 0.5});
  pdf.BeginClip(box);
  pdf.DrawPolyline({{60, 300}, {160, 420}, {260, 300}}, {ColorOf(0x1F5FA8), 1, Dash::kDashed});
  pdf.FillPolygon({{100, 310}, {120, 310}, {110, 330}}, ColorOf(0xB3261E));
  pdf.FillCircle({160, 350}, 5, ColorOf(0x1B7F3B));
  pdf.EndClip();
  RgbImage image{64, 48, std::vector<unsigned char>(64 * 48 * 3)};
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<unsigned char>(i * i / 97);
  pdf.DrawImage(image, {180, 310, 64, 48});
}

void DrawFrames(PdfDocument& pdf) {
  for (int page = 0; page < pdf.PageCount(); ++page) {
    pdf.SelectPage(page);
    const ScopedDecoration footer(pdf, Decoration::kPageFooter);
    pdf.DrawText(kText, {300, 30}, "Page " + std::to_string(page + 1), Align::kCenter);
  }
}

}  // namespace

PdfInfo SampleInfo() {
  PdfInfo info;
  info.title = "Sample & proof";
  info.author = "张伟 <Prüfzentrum>";
  info.subject = "Strain in µε";
  info.keywords = "pipe; strain";
  info.creator = "telestrain tests";
  info.created = "D:20260131101500Z";
  return info;
}

std::vector<std::string> SampleLines() {
  return {"测量不确定度：应变 张伟", "✓ pass µε Ω Å ≤ 3 µm", "Łódź – Ångström ḗ ṩ ộ"};
}

std::vector<PdfAttachment> SampleAttachments() {
  std::string all_bytes;
  for (int i = 0; i < 70000; ++i) all_bytes += static_cast<char>(i);
  return {{"results.json", "application/json", "Numbers", "Data", "{\"a\": 1}\n"},
          {"audit.jsonl", "application/x-ndjson", "Trail – 记录", "Supplement", all_bytes},
          {"empty.txt", "text/plain", "Nothing", "Unspecified", ""}};
}

std::string SamplePdf(ArchiveLevel level, const PdfInfo& info) {
  auto created = PdfDocument::Create(level);
  if (!created) throw std::runtime_error(created.error().message);
  PdfDocument& pdf = *created.value();
  pdf.AddPage();
  DrawTagged(pdf, {"H1"}, {60, 780}, "Sample");
  pdf.AddBookmark("Sample 测 \xF0\x9F\x98\x80", 1, 790);
  double y_pt = 740;
  for (const std::string& line : SampleLines()) DrawTagged(pdf, {"P"}, {60, y_pt -= 20}, line);
  {
    const ScopedTag paragraph(pdf, PdfTag{"P"});
    const ScopedTag link(pdf, PdfTag{"Link", "The figure"});
    pdf.DrawText(kText, {60, 600}, "see the figure");
    pdf.AddLink({60, 598, 70, 12}, "figure");
  }
  DrawTable(pdf);
  DrawTagged(pdf, {"H2"}, {60, 700}, "Figure");
  pdf.AddBookmark("Figure", 2, 710);
  pdf.AddDestination("figure", 710);
  DrawFigure(pdf);
  pdf.AddPage();
  DrawTagged(pdf, {"H2"}, {60, 780}, "Signatures");
  DrawTagged(pdf, {"P"}, {60, 730}, "Operator");
  pdf.AddSignatureField("operator", "Signature of the operator", {60, 660, 150, 40});
  pdf.AddSignatureField("operator", "left out", {260, 660, 150, 40});
  DrawFrames(pdf);
  for (const PdfAttachment& attachment : SampleAttachments()) pdf.Attach(attachment);
  auto saved = pdf.Save(info, "seed");
  if (!saved) throw std::runtime_error(saved.error().message);
  return saved.value();
}

}  // namespace telestrain
