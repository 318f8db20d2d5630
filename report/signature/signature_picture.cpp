#include "report/signature/signature_picture.h"

#include <vector>

#include "report/pdf_document.h"
#include "report/text_wrap.h"

namespace telestrain {
namespace {

constexpr double kMargin_pt = 3;
constexpr double kLargest_pt = 7.5, kSmallest_pt = 5.5, kStep_pt = 0.25;
constexpr double kLeading = 1.2;
constexpr double kFlat_pt = 36;  // less holds four lines of 5.5 pt to 7.5 pt, not all of them
constexpr Color kInk = ColorOf(0x14324F);
constexpr Color kWarning = ColorOf(0xB00020);

struct Line {
  Face face;
  std::string text;
  Color color;
  bool wraps = false;
};

// The paragraphs; the reason is the one that may take several lines. A flat box has the facts side
// by side.
std::vector<Line> LinesOf(const SignaturePicture& picture) {
  std::string role = picture.role;
  role.front() = static_cast<char>(role.front() - 'a' + 'A');
  const bool flat = picture.height_pt < kFlat_pt;
  std::string when = role + ", " + picture.time;
  const std::string hash = "SHA-256 " + picture.fingerprint.substr(0, 16);
  if (flat) when += " · " + hash + (picture.place.empty() ? "" : " · " + picture.place);
  std::vector<Line> lines = {{Face::kBold, picture.name, kInk}, {Face::kRegular, when, kInk}};
  if (!picture.reason.empty()) lines.push_back({Face::kRegular, picture.reason, kInk, true});
  if (!flat && !picture.place.empty()) lines.push_back({Face::kRegular, picture.place, kInk});
  if (picture.demonstration)
    lines.push_back({Face::kBold, "Demonstration key – not for production", kWarning});
  if (!flat) lines.push_back({Face::kRegular, hash, kInk});
  return lines;
}

// The rows of text at one size.
class Rows {
 public:
  Rows(PdfDocument& pdf, const SignaturePicture& picture, double size_pt)
      : pdf_(pdf),
        size_pt_(size_pt),
        width_pt_(picture.width_pt - 2 * kMargin_pt),
        most_(static_cast<std::size_t>((picture.height_pt - kMargin_pt) / (kLeading * size_pt))) {
    const auto lines = LinesOf(picture);
    for (const Line& line : lines) Add(line, lines.size() - 1);
    fits_ = fits_ && rows_.size() <= most_;
  }
  bool fits() const { return fits_; }
  void Draw(double top_pt) {
    double y_pt = top_pt - kMargin_pt / 2;
    for (const Line& row : rows_) {
      y_pt -= kLeading * size_pt_;
      // The base line leaves room for descenders, a fifth of the size.
      pdf_.DrawText(StyleOf(row), {kMargin_pt, y_pt + 0.22 * kLeading * size_pt_}, row.text);
    }
  }

 private:
  TextStyle StyleOf(const Line& line) const { return {line.face, size_pt_, line.color}; }

  // `others`: how many rows the other lines take.
  void Add(Line line, std::size_t others) {
    const TextStyle style = StyleOf(line);
    auto parts = line.wraps ? WrapText(pdf_, style, line.text, width_pt_)
                            : std::vector<std::string>{line.text};
    const std::size_t room = line.wraps && most_ > others + 1 ? most_ - others : 1;
    fits_ = fits_ && parts.size() <= room;
    for (; parts.size() > room; parts.pop_back()) parts[parts.size() - 2] += parts.back();
    for (const std::string& part : parts) {
      // A row that was broken at a space ends with it.
      const std::string word = part.substr(0, part.find_last_not_of(' ') + 1);
      line.text = ShortenedText(pdf_, style, word, width_pt_);
      fits_ = fits_ && line.text == word;
      rows_.push_back(line);
    }
  }

  PdfDocument& pdf_;
  double size_pt_, width_pt_;
  std::size_t most_;
  bool fits_ = true;
  std::vector<Line> rows_;
};

}  // namespace

Result<std::string> DrawSignaturePicture(const SignaturePicture& picture) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto pdf, PdfDocument::Create());
  pdf->AddPage();
  // What stands in an unsigned box is for signing by hand.
  pdf->FillBox({0, 0, picture.width_pt, picture.height_pt}, kSignatureGround);
  double size_pt = kLargest_pt;
  while (size_pt > kSmallest_pt && !Rows(*pdf, picture, size_pt).fits()) size_pt -= kStep_pt;
  Rows(*pdf, picture, size_pt).Draw(picture.height_pt);
  PdfInfo info;
  info.title = "Signature";
  info.creator = "telestrain";
  return pdf->Save(info, "signature");
}

}  // namespace telestrain
