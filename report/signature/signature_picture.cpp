#include "report/signature/signature_picture.h"

#include <algorithm>
#include <vector>

#include "report/pdf_document.h"
#include "report/unicode_text.h"

namespace telestrain {
namespace {

constexpr double kMargin_pt = 3;
constexpr double kLargest_pt = 7.5;
constexpr double kSmallest_pt = 4;
constexpr double kFlat_pt = 36;  // five lines would be below 6 pt
constexpr Color kInk = ColorOf(0x14324F);
constexpr Color kWarning = ColorOf(0xB00020);

struct Line {
  Face face;
  std::string text;
  Color color;
};

// A flat box has the facts side by side.
std::vector<Line> LinesOf(const SignaturePicture& picture) {
  std::string role = picture.role;
  role.front() = static_cast<char>(role.front() - 'a' + 'A');
  std::string why = picture.reason;
  if (!picture.place.empty()) why += (why.empty() ? "" : ", ") + picture.place;
  const std::string when = role + ", " + picture.time;
  const std::string hash = "SHA-256 " + picture.fingerprint.substr(0, 16);
  std::vector<Line> lines = {{Face::kBold, picture.name, kInk}};
  if (picture.height_pt < kFlat_pt)
    lines.push_back({Face::kRegular, when + " · " + hash, kInk});
  else
    lines.push_back({Face::kRegular, when, kInk});
  if (!why.empty()) lines.push_back({Face::kRegular, why, kInk});
  if (picture.demonstration)
    lines.push_back({Face::kBold, "Demonstration key – not for production", kWarning});
  if (picture.height_pt >= kFlat_pt) lines.push_back({Face::kRegular, hash, kInk});
  return lines;
}

// The text, as much of it as fits.
std::string Cut(PdfDocument& pdf, const TextStyle& style, const std::string& text,
                double width_pt) {
  if (pdf.TextWidth_pt(style, text) <= width_pt) return text;
  std::vector<char32_t> points = CodePoints(text);
  std::string shorter;
  do {
    points.pop_back();
    shorter.clear();
    for (const char32_t point : points) shorter += Utf8(point);
    shorter += "…";
  } while (!points.empty() && pdf.TextWidth_pt(style, shorter) > width_pt);
  return shorter;
}

}  // namespace

Result<std::string> DrawSignaturePicture(const SignaturePicture& picture) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto pdf, PdfDocument::Create());
  pdf->AddPage();
  const auto lines = LinesOf(picture);
  const double width_pt = picture.width_pt - 2 * kMargin_pt;
  const double line_pt = (picture.height_pt - kMargin_pt) / static_cast<double>(lines.size());
  double y_pt = picture.height_pt - kMargin_pt / 2;
  for (const Line& line : lines) {
    TextStyle style{line.face, std::min(kLargest_pt, line_pt / 1.2), line.color};
    const double natural_pt = pdf->TextWidth_pt(style, line.text);
    if (natural_pt > width_pt)
      style.size_pt =
          std::max(std::min(kSmallest_pt, style.size_pt), style.size_pt * width_pt / natural_pt);
    // The base line leaves room for descenders, a fifth of the size.
    const double step_pt = std::min(line_pt, 1.32 * kLargest_pt);
    y_pt -= step_pt;
    pdf->DrawText(style, {kMargin_pt, y_pt + 0.22 * step_pt},
                  Cut(*pdf, style, line.text, width_pt));
  }
  PdfInfo info;
  info.title = "Signature";
  info.creator = "telestrain";
  return pdf->Save(info, "signature");
}

}  // namespace telestrain
