#include "report/report_blocks.h"
#include "report/text_wrap.h"

namespace telestrain {
namespace {

// Shrinks a line a little until it fits beside the other one, then shortens it: page 1 has it in
// full.
void DrawFrameLine(PageFlow& flow, TextStyle style, double y_pt, const std::string& text,
                   Align align) {
  const double room_pt = flow.width_pt() * (align == Align::kLeft ? 0.72 : 0.26);
  while (style.size_pt > 6.5 && flow.pdf().TextWidth_pt(style, text) > room_pt)
    style.size_pt -= 0.25;
  const double x_pt = align == Align::kLeft ? flow.left_pt() : flow.right_pt();
  flow.pdf().DrawText(style, {x_pt, y_pt}, ShortenedText(flow.pdf(), style, text, room_pt), align);
}

}  // namespace

void DrawPageFrames(const ReportContext& context) {
  PageFlow& flow = context.flow;
  PdfDocument& pdf = flow.pdf();
  const Look& look = flow.look();
  Json values = context.values;
  values["pages"] = pdf.PageCount();
  const double header_pt = kPageHeight_pt - 15 * kPointsPerMm, footer_pt = 13 * kPointsPerMm;
  for (int page = 0; page < pdf.PageCount(); ++page) {
    pdf.SelectPage(page);
    values["page"] = page + 1;
    const auto text = [&](const char* key) {
      return context.layout.Fill(TextAt(context.layout.json(), key), values);
    };
    pdf.BeginDecoration(Decoration::kPageFooter);
    pdf.DrawLine({flow.left_pt(), footer_pt + 12}, {flow.right_pt(), footer_pt + 12},
                 {look.line, 0.6});
    DrawFrameLine(flow, {Face::kRegular, 7.5, look.muted}, footer_pt, text("/footer/left"),
                  Align::kLeft);
    DrawFrameLine(flow, {Face::kRegular, 7.5, look.muted}, footer_pt, text("/footer/right"),
                  Align::kRight);
    pdf.EndDecoration();
    if (page == 0) continue;  // the title band says it larger
    const ScopedDecoration header(pdf, Decoration::kPageHeader);
    DrawFrameLine(flow, {Face::kBold, 8.5, look.accent}, header_pt, text("/header/left"),
                  Align::kLeft);
    DrawFrameLine(flow, {Face::kRegular, 8.5, look.muted}, header_pt, text("/header/right"),
                  Align::kRight);
    pdf.DrawLine({flow.left_pt(), header_pt - 6}, {flow.right_pt(), header_pt - 6},
                 {look.accent, 0.8});
  }
}

}  // namespace telestrain
