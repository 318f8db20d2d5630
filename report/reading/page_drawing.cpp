#include "report/reading/page_drawing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <qpdf/QPDFPageObjectHelper.hh>
#include <stdexcept>

#include "report/reading/drawing_state.h"
#include "report/unicode_text.h"

namespace telestrain {
namespace {

// Far more than a page of ours has.
constexpr std::size_t kMostOperands = 64, kMostKept = 100;
constexpr std::size_t kMostBoxes = 1000000, kMostPieces = 100000;
// Of the size of the type: hexadecimal digits are no wider and no higher.
constexpr double kDigitWidth = 0.6, kDigitHeight = 0.7;

void Require(bool holds, const std::string& reason) {
  if (!holds) throw std::runtime_error(reason);
}

DrawnBox BoxOf(QPDFObjectHandle array) {
  Require(array.isArray() && array.getArrayNItems() == 4, "a page of it has no size");
  std::vector<double> n;
  for (QPDFObjectHandle item : array.getArrayAsVector()) {
    Require(item.isNumber(), "a page of it has no size");
    n.push_back(item.getNumericValue());
  }
  return BoxAbout({{n[0], n[1]}, {n[2], n[3]}});
}

class Drawer : public QPDFObjectHandle::ParserCallbacks {
 public:
  Drawer(QPDFObjectHandle resources, const DrawnBox& page);
  void handleObject(QPDFObjectHandle object) override;
  void handleEOF() override { EndPiece(); }
  void Cover(const DrawnBox& box, double luminance, bool is_filled);
  PageDrawing& drawing() { return drawing_; }

 private:
  std::vector<double> Numbers(std::size_t count) const;
  std::array<double, 2> Point(std::size_t first, std::size_t count) const;
  QPDFObjectHandle Resource(const char* kind) const;
  void Keep(bool keep);
  void MarkContent();
  void AddRectangle();
  void AddCurve();
  void Paint(bool fills);
  void EndPath();
  void DrawImage();
  void SelectFont();
  void SetTextMatrix();
  void Show();
  void EndPiece();

  QPDFObjectHandle resources_;
  std::vector<QPDFObjectHandle> operands_;
  std::map<std::string, std::function<void()>> operators_;
  DrawingState state_;
  std::vector<DrawingState> kept_;
  DrawnPath path_;
  bool clips_ = false, has_font_ = false, has_place_ = false;
  double type_pt_ = 0;
  DrawingMatrix text_matrix_;
  TextPiece piece_;
  std::size_t letters_ = 0;
  PageDrawing drawing_;
};

// The operators that our writer uses; the page's looks depend on no others.
Drawer::Drawer(QPDFObjectHandle resources, const DrawnBox& page)
    : resources_(std::move(resources)) {
  state_.clip = page;
  const auto nothing = [] {};
  operators_ = {
      {"q", [this] { Keep(true); }},
      {"Q", [this] { Keep(false); }},
      {"cm", [this] { state_.matrix = DrawingMatrix::Of(Numbers(6)).Then(state_.matrix); }},
      {"w", [this] { state_.line_width_pt = std::abs(Numbers(1)[0]); }},
      {"rg",
       [this] {
         const auto n = Numbers(3);
         state_.fill_luminance = 0.299 * n[0] + 0.587 * n[1] + 0.114 * n[2];
       }},
      {"m", [this] { path_.MoveTo(Point(0, 2)); }},
      {"l", [this] { path_.LineTo(Point(0, 2)); }},
      {"c", [this] { AddCurve(); }},
      {"re", [this] { AddRectangle(); }},
      {"f", [this] { Paint(true); }},
      {"S", [this] { Paint(false); }},
      {"W", [this] { clips_ = true; }},
      {"n", [this] { EndPath(); }},
      {"Do", [this] { DrawImage(); }},
      {"BDC", [this] { MarkContent(); }},
      {"BT", [this] { EndPiece(); }},
      {"ET", [this] { EndPiece(); }},
      {"Tm", [this] { SetTextMatrix(); }},
      {"Tf", [this] { SelectFont(); }},
      {"Tj", [this] { Show(); }},
  };
  for (const char* name : {"EMC", "RG", "J", "j", "d", "h"}) operators_[name] = nothing;
}

void Drawer::handleObject(QPDFObjectHandle object) {
  if (!object.isOperator()) {
    Require(operands_.size() < kMostOperands, "a page of it is malformed");
    operands_.push_back(object);
    return;
  }
  const auto found = operators_.find(object.getOperatorValue());
  Require(found != operators_.end(), "a page of it draws with " + object.getOperatorValue() +
                                         ", which no report of ours does");
  found->second();
  operands_.clear();
}

std::vector<double> Drawer::Numbers(std::size_t count) const {
  Require(operands_.size() == count, "a page of it is malformed");
  std::vector<double> numbers;
  for (QPDFObjectHandle operand : operands_) {
    Require(operand.isNumber(), "a page of it is malformed");
    numbers.push_back(operand.getNumericValue());
  }
  return numbers;
}

std::array<double, 2> Drawer::Point(std::size_t first, std::size_t count) const {
  const auto n = Numbers(count);
  return state_.matrix.At(n[first], n[first + 1]);
}

QPDFObjectHandle Drawer::Resource(const char* kind) const {
  QPDFObjectHandle resources = resources_;
  QPDFObjectHandle all =
      resources.isDictionary() ? resources.getKey(kind) : QPDFObjectHandle::newNull();
  QPDFObjectHandle name = operands_.empty() ? QPDFObjectHandle::newNull() : operands_.front();
  Require(all.isDictionary() && name.isName(), "a page of it is malformed");
  return all.getKey(name.getName());
}

void Drawer::Keep(bool keep) {
  EndPiece();
  if (keep) {
    Require(kept_.size() < kMostKept, "a page of it is nested too deeply");
    kept_.push_back(state_);
    return;
  }
  Require(!kept_.empty(), "a page of it is malformed");
  state_ = kept_.back();
  kept_.pop_back();
}

void Drawer::MarkContent() {
  Require(!operands_.empty() && !operands_.front().isNameAndEquals("/OC"),
          "a page of it has layers, which no report of ours has");
}

void Drawer::AddRectangle() {
  const auto n = Numbers(4);
  path_.Rectangle(
      BoxAbout({state_.matrix.At(n[0], n[1]), state_.matrix.At(n[0] + n[2], n[1]),
                state_.matrix.At(n[0], n[1] + n[3]), state_.matrix.At(n[0] + n[2], n[1] + n[3])}),
      state_.matrix.KeepsBoxes());
}

// Stays inside the box about its points.
void Drawer::AddCurve() {
  for (std::size_t first : {0u, 2u, 4u}) path_.LineTo(Point(first, 6));
}

void Drawer::Cover(const DrawnBox& box, double luminance, bool is_filled) {
  Require(drawing_.boxes.size() < kMostBoxes, "a page of it draws too much");
  const DrawnBox seen = Common(box, state_.clip);
  if (seen.IsEmpty()) return;
  const std::size_t order = drawing_.boxes.size() + drawing_.pieces.size();
  drawing_.boxes.push_back({seen, luminance, is_filled && state_.clip_is_exact, order});
}

void Drawer::Paint(bool fills) {
  EndPiece();
  const DrawingMatrix& m = state_.matrix;
  const double scale = std::max({std::abs(m.a), std::abs(m.b), std::abs(m.c), std::abs(m.d)});
  // Ends and corners of a line reach over its points by no more than its width.
  const double half_pt = state_.line_width_pt * scale;
  if (fills) Cover(path_.box(), state_.fill_luminance, path_.IsOneBox());
  if (!fills)
    for (const DrawnBox& line : path_.lines())
      Cover({line.left_pt - half_pt, line.bottom_pt - half_pt, line.right_pt + half_pt,
             line.top_pt + half_pt},
            -1, false);
  EndPath();
}

void Drawer::EndPath() {
  EndPiece();
  if (clips_) {
    state_.clip = Common(state_.clip, path_.box());
    state_.clip_is_exact = state_.clip_is_exact && path_.IsOneBox();
  }
  clips_ = false;
  path_ = {};
}

void Drawer::DrawImage() {
  EndPiece();
  QPDFObjectHandle image = Resource("/XObject");
  Require(image.isStream() && image.getDict().getKey("/Subtype").isNameAndEquals("/Image"),
          "a page of it draws a form, which no report of ours does");
  const DrawingMatrix& m = state_.matrix;
  Cover(BoxAbout({m.At(0, 0), m.At(1, 0), m.At(0, 1), m.At(1, 1)}), -1, false);
}

void Drawer::SelectFont() {
  Require(operands_.size() == 2 && operands_[1].isNumber(), "a page of it is malformed");
  QPDFObjectHandle font = Resource("/Font");
  Require(font.isDictionary() && font.getKey("/Subtype").isNameAndEquals("/Type0"),
          "a page of it has a font of another kind than ours");
  has_font_ = true;
  type_pt_ = operands_[1].getNumericValue();
}

void Drawer::SetTextMatrix() {
  EndPiece();
  text_matrix_ = DrawingMatrix::Of(Numbers(6));
  has_place_ = true;
}

// UTF-16 units, high byte first.
void Drawer::Show() {
  Require(operands_.size() == 1 && operands_[0].isString() && has_font_,
          "a page of it is malformed");
  const DrawingMatrix to_page = text_matrix_.Then(state_.matrix);
  const double size_pt = type_pt_ * std::min(to_page.a, to_page.d);
  if (letters_ == 0) {
    piece_ = {};
    const auto [x, y] = to_page.At(0, 0);
    piece_.x_pt = x, piece_.y_pt = y, piece_.size_pt = size_pt;
    piece_.box = {x, y, x, y};
    piece_.luminance = state_.fill_luminance;
  }
  piece_.is_upright = piece_.is_upright && has_place_ && to_page.IsUpright() && size_pt > 0 &&
                      piece_.luminance == state_.fill_luminance;
  piece_.size_pt = std::min(piece_.size_pt, size_pt);
  piece_.clip = state_.clip_is_exact ? state_.clip : DrawnBox{};
  const std::string codes = operands_[0].getStringValue();
  for (std::size_t i = 0; i + 1 < codes.size(); i += 2, ++letters_) {
    const auto point = static_cast<char32_t>(static_cast<unsigned char>(codes[i]) << 8 |
                                             static_cast<unsigned char>(codes[i + 1]));
    // Our writer draws the basic plane only, of which half a pair is no character.
    piece_.text += Utf8(point >= 0xD800 && point < 0xE000 ? char32_t{0xFFFD} : point);
    piece_.box.right_pt += kDigitWidth * std::abs(type_pt_ * to_page.a);
  }
  piece_.box.top_pt =
      std::max(piece_.box.top_pt, piece_.y_pt + kDigitHeight * std::abs(type_pt_ * to_page.d));
}

// What would be shown next without a new place stands behind this: where, only the font knows.
void Drawer::EndPiece() {
  has_place_ = false;
  if (letters_ == 0) return;
  Require(drawing_.pieces.size() < kMostPieces, "a page of it has too much text");
  piece_.order = drawing_.boxes.size() + drawing_.pieces.size();
  drawing_.pieces.push_back(std::move(piece_));
  piece_ = {};
  letters_ = 0;
}

// A link without looks covers nothing.
void CoverByAnnotations(QPDFObjectHandle page, Drawer& drawer) {
  QPDFObjectHandle notes = page.getKey("/Annots");
  if (!notes.isArray()) return;
  for (QPDFObjectHandle note : notes.getArrayAsVector())
    if (note.isDictionary() && (note.hasKey("/AP") || note.hasKey("/V")))
      drawer.Cover(BoxOf(note.getKey("/Rect")), -1, false);
}

}  // namespace

PageDrawing ReadDrawing(QPDF& pdf, QPDFObjectHandle page, const std::string& content) {
  QPDFPageObjectHelper helper(page);
  for (const char* name : {"/CropBox", "/Rotate"})
    Require(helper.getAttribute(name, false).isNull(), "a page of it is cropped or turned");
  const DrawnBox box = BoxOf(helper.getAttribute("/MediaBox", false));
  Drawer drawer(helper.getAttribute("/Resources", false), box);
  QPDFObjectHandle::parseContentStream(QPDFObjectHandle::newStream(&pdf, content), &drawer);
  Drawer over(QPDFObjectHandle::newNull(), box);
  CoverByAnnotations(page, over);
  PageDrawing& drawing = drawer.drawing();
  for (PaintedBox& covering : over.drawing().boxes) {
    covering.order = drawing.boxes.size() + drawing.pieces.size();
    drawing.boxes.push_back(covering);
  }
  return std::move(drawing);
}

}  // namespace telestrain
