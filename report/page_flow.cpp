#include "report/page_flow.h"

#include <algorithm>
#include <cmath>

#include "report/text_wrap.h"

namespace telestrain {
namespace {

// 170 mm wide, so that a picture of 2008 px fills it at 300 dpi.
constexpr double kSideMargin_pt = 20 * kPointsPerMm;
constexpr double kTop_pt = kPageHeight_pt - 24 * kPointsPerMm;
constexpr double kBottom_pt = 22 * kPointsPerMm;
constexpr double kAscent = 0.94;  // of the size: where the base line stands in its line

// How many of `left` lines go on this page, where `room` lines fit: on both sides of a break stand
// at least two. 0: start a new one.
std::size_t LinesHere(std::size_t left, double room) {
  constexpr std::size_t kFewest = 2;
  const std::size_t here = static_cast<std::size_t>(std::max(0.0, std::floor(room + 1e-6)));
  if (left <= here) return left;
  const std::size_t count = std::min(here, left - std::min(left, kFewest));
  return count < kFewest ? 0 : count;
}

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
  const std::vector<std::string> lines = WrapText(pdf_, style, text, width_pt());
  for (std::size_t i = 0; i < lines.size();) {
    const std::size_t end = i + LinesHere(lines.size() - i, Free_pt() / style.LineHeight_pt());
    if (end == i) {
      StartPage();
      continue;
    }
    for (; i < end; ++i) {
      pdf_.DrawText(style, {left_pt(), y_pt_ - kAscent * style.size_pt}, lines[i]);
      Advance(style.LineHeight_pt());
    }
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
