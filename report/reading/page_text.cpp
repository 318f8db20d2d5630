#include "report/reading/page_text.h"

#include <qpdf/Pipeline.hh>
#include <qpdf/QPDFPageObjectHelper.hh>
#include <stdexcept>
#include <vector>

#include "report/unicode_text.h"

namespace telestrain {
namespace {

// Takes bytes up to a limit.
class LimitedText : public Pipeline {
 public:
  explicit LimitedText(std::size_t limit) : Pipeline("limited text", nullptr), limit_(limit) {}
  void write(unsigned char const* data, std::size_t size) override {
    if (size > limit_ - text_.size()) throw std::runtime_error("a stream of it is too long");
    text_.append(reinterpret_cast<const char*>(data), size);
  }
  void finish() override {}
  std::string& text() { return text_; }

 private:
  std::size_t limit_;
  std::string text_;
};

// Collects what the text operators of a content stream show.
class TextCollector : public QPDFObjectHandle::ParserCallbacks {
 public:
  explicit TextCollector(QPDFObjectHandle fonts) : fonts_(std::move(fonts)) {}

  void handleObject(QPDFObjectHandle object) override {
    if (!object.isOperator()) {
      if (operands_.size() < kMostOperands) operands_.push_back(object);
      return;
    }
    Handle(object.getOperatorValue());
    operands_.clear();
  }
  void handleEOF() override { EndPiece(); }
  std::string& text() { return text_; }

 private:
  static constexpr std::size_t kMostOperands = 64;  // our writer needs six

  void Handle(const std::string& name) {
    if (name == "Tf" && operands_.size() == 2 && operands_[0].isName())
      SelectFont(operands_[0].getName());
    if (name == "BT" || name == "ET" || name == "Tm" || name == "Td" || name == "TD" ||
        name == "T*" || name == "'" || name == "\"")
      EndPiece();
    if (name == "Tj" || name == "TJ" || name == "'" || name == "\"") ShowLastOperand();
  }

  void SelectFont(const std::string& name) {
    QPDFObjectHandle font = fonts_.isDictionary() ? fonts_.getKey(name) : fonts_;
    font_is_ours_ = font.isDictionary() && font.getKey("/Subtype").isNameAndEquals("/Type0");
  }

  void ShowLastOperand() {
    if (!font_is_ours_ || operands_.empty()) return;
    QPDFObjectHandle shown = operands_.back();
    if (shown.isString()) Show(shown.getStringValue());
    if (!shown.isArray()) return;
    for (QPDFObjectHandle item : shown.getArrayAsVector())
      if (item.isString()) Show(item.getStringValue());
  }

  // UTF-16 units, high byte first.
  void Show(const std::string& codes) {
    for (std::size_t i = 0; i + 1 < codes.size(); i += 2) {
      const auto high = static_cast<unsigned char>(codes[i]);
      const auto low = static_cast<unsigned char>(codes[i + 1]);
      const auto point = static_cast<char32_t>(high << 8 | low);
      // Our writer draws the basic plane only, of which half a pair is no character.
      piece_ += Utf8(point >= 0xD800 && point < 0xE000 ? char32_t{0xFFFD} : point);
    }
  }

  void EndPiece() {
    if (!piece_.empty()) text_ += piece_ + "\n";
    piece_.clear();
  }

  QPDFObjectHandle fonts_;
  std::vector<QPDFObjectHandle> operands_;
  bool font_is_ours_ = false;
  std::string piece_, text_;
};

std::string ContentOf(QPDFObjectHandle page, std::size_t limit) {
  QPDFObjectHandle contents = page.getKey("/Contents");
  std::string bytes;
  const std::vector<QPDFObjectHandle> streams =
      contents.isArray() ? contents.getArrayAsVector() : std::vector{contents};
  for (QPDFObjectHandle stream : streams)
    if (stream.isStream()) bytes += StreamBytes(stream, limit - bytes.size()) + "\n";
  if (bytes.size() > limit) throw std::runtime_error("a page of it is too long");
  return bytes;
}

}  // namespace

std::string StreamBytes(QPDFObjectHandle stream, std::size_t limit) {
  LimitedText text(limit);
  bool decoded = false;
  if (!stream.pipeStreamData(&text, &decoded, 0, qpdf_dl_generalized, false, false) || !decoded)
    throw std::runtime_error("a stream of it is damaged or too long");
  return std::move(text.text());
}

std::string PageText(QPDF& pdf, QPDFObjectHandle page, std::size_t limit) {
  const std::string content = ContentOf(page, limit);
  QPDFPageObjectHelper helper(page);
  QPDFObjectHandle resources = helper.getAttribute("/Resources", false);
  TextCollector collector(resources.isDictionary() ? resources.getKey("/Font")
                                                   : QPDFObjectHandle::newNull());
  QPDFObjectHandle::parseContentStream(QPDFObjectHandle::newStream(&pdf, content), &collector);
  return std::move(collector.text());
}

}  // namespace telestrain
