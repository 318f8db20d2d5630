#include "report/page_flow.h"

#include "report/text_wrap.h"

namespace telestrain {
namespace {

// 170 mm wide, so that a picture of 2008 px fills it at 300 dpi.
constexpr double kSideMargin_pt = 20 * kPointsPerMm;
constexpr double kTop_pt = kPageHeight_pt - 24 * kPointsPerMm;
constexpr double kBottom_pt = 22 * kPointsPerMm;
constexpr double kAscent = 0.94;  // of the size: where the base line stands in its line

}  // namespace

Color Look::OfVerdict(const std::string& verdict) const {
  if (verdict == "pass") return pass;
  if (verdict == "doubt") return doubt;
  return verdict == "fail" ? fail : muted;
}

PageFlow::PageFlow(PdfDocument& pdf, const Look& look) : pdf_(pdf), look_(look) {}

double PageFlow::left_pt() const { return kSideMargin_pt; }
double PageFlow::width_pt() const { return kPageWidth_pt - 2 * kSideMargin_pt; }
double PageFlow::Free_pt() const { return y_pt_ - kBottom_pt; }
double PageFlow::PageBody_pt() const { return kTop_pt - kBottom_pt; }

void PageFlow::StartPage() {
  pdf_.AddPage();
  y_pt_ = kTop_pt;
}

void PageFlow::StartPageUnlessEmpty() {
  if (y_pt_ < kTop_pt - 0.1) StartPage();
}

void PageFlow::Require(double height_pt) {
  if (y_pt_ - height_pt < kBottom_pt) StartPageUnlessEmpty();
}

void PageFlow::Paragraph(const TextStyle& style, const std::string& text, const PdfTag& tag) {
  const ScopedTag paragraph(pdf_, tag);
  for (const std::string& line : WrapText(pdf_, style, text, width_pt())) {
    Require(style.LineHeight_pt());
    pdf_.DrawText(style, {left_pt(), y_pt_ - kAscent * style.size_pt}, line);
    Advance(style.LineHeight_pt());
  }
}

double PageFlow::TextBlock(const TextStyle& style, PagePoint top_left, double width_pt,
                           const std::string& text, Align align) {
  const double share = align == Align::kLeft ? 0 : align == Align::kCenter ? 0.5 : 1;
  double y_pt = top_left.y_pt;
  for (const std::string& line : WrapText(pdf_, style, text, width_pt)) {
    pdf_.DrawText(style, {top_left.x_pt + share * width_pt, y_pt - kAscent * style.size_pt}, line,
                  align);
    y_pt -= style.LineHeight_pt();
  }
  return top_left.y_pt - y_pt;
}

double PageFlow::TextHeight_pt(const TextStyle& style, double width_pt, const std::string& text) {
  return static_cast<double>(WrapText(pdf_, style, text, width_pt).size()) * style.LineHeight_pt();
}

}  // namespace telestrain
