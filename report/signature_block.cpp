#include "report/signature_block.h"

#include <cctype>

namespace telestrain {
namespace {

constexpr double kRoleHeight_pt = 84, kSealHeight_pt = 34, kGap_pt = 10, kInset_pt = 8;
constexpr const char* kInstrument = "Instrument";

std::string FieldName(const std::string& role) {
  std::string name;
  for (const char c : role)
    name += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

// Draws the boxes of one block.
class SignatureBoxes {
 public:
  SignatureBoxes(const ReportContext& context, const std::string& note)
      : context_(context), flow_(context.flow), look_(context.flow.look()), note_(note) {}

  // Name above, the line to sign on below, what belongs there under it.
  void DrawRole(const PageBox& box, const std::string& role) {
    DrawFrame(box);
    const double inner_pt = box.width_pt - 2 * kInset_pt, line_pt = box.bottom_pt + 24;
    const PagePoint line{box.left_pt + kInset_pt, line_pt};
    flow_.pdf().DrawLine(line, {line.x_pt + inner_pt, line_pt}, {look_.muted, 0.5});
    const double name_pt =
        DrawWords(NameStyle(), {line.x_pt, box.top_pt() - 6}, inner_pt, context_.layout.Say(role));
    AddField(role, {line.x_pt, line_pt + 1, inner_pt, box.top_pt() - 6 - name_pt - line_pt - 2});
    DrawWords(NoteStyle(), {line.x_pt, line_pt - 3}, inner_pt, note_);
  }

  // Name at the left, the seal at the right.
  void DrawSeal(const PageBox& box) {
    DrawFrame(box);
    const double half_pt = box.width_pt / 2 - kInset_pt;
    const PagePoint at{box.left_pt + kInset_pt, box.top_pt() - 6};
    const double name_pt = DrawWords(NameStyle(), at, half_pt, context_.layout.Say(kInstrument));
    DrawWords(NoteStyle(), {at.x_pt, at.y_pt - name_pt}, half_pt,
              context_.layout.Say("Seal of the instrument"));
    AddField(kInstrument,
             {box.left_pt + box.width_pt / 2, box.bottom_pt + 2, half_pt, box.height_pt - 4});
  }

 private:
  TextStyle NameStyle() const { return {Face::kBold, 9, look_.accent}; }
  TextStyle NoteStyle() const { return {Face::kRegular, 7.5, look_.muted}; }
  void DrawFrame(const PageBox& box) {
    flow_.pdf().FillBox(box, ColorOf(0xFAFBFC));
    flow_.pdf().StrokeBox(box, {look_.line, 0.8});
  }
  double DrawWords(const TextStyle& style, PagePoint at, double width_pt, const std::string& text) {
    const ScopedTag paragraph(flow_.pdf(), PdfTag{"P"});
    return flow_.TextBlock(style, at, width_pt, text);
  }
  void AddField(const std::string& role, const PageBox& box) {
    const std::string tip =
        context_.layout.Say("Digital signature") + ": " + context_.layout.Say(role);
    flow_.pdf().AddSignatureField(FieldName(role), tip, box);
  }

  const ReportContext& context_;
  PageFlow& flow_;
  const Look& look_;
  std::string note_;
};

}  // namespace

Status DrawSignatures(const ReportContext& context, const Json& block) {
  PageFlow& flow = context.flow;
  const Json& roles = ListAt(block, "/roles");
  const double count = static_cast<double>(roles.size());
  const double width_pt = (flow.width_pt() - kGap_pt * (count - 1)) / count;
  const double height_pt = kRoleHeight_pt + kGap_pt + kSealHeight_pt;
  flow.Require(height_pt + kGap_pt);
  SignatureBoxes boxes(context, context.Fill(block, "note"));
  PageBox box{flow.left_pt(), flow.y_pt() - kRoleHeight_pt, width_pt, kRoleHeight_pt};
  for (const Json& role : roles) {
    boxes.DrawRole(box, role.get<std::string>());
    box.left_pt += width_pt + kGap_pt;
  }
  boxes.DrawSeal({flow.left_pt(), flow.y_pt() - height_pt, flow.width_pt(), kSealHeight_pt});
  flow.Advance(height_pt + 12);
  return {};
}

}  // namespace telestrain
