#include "report/reading/page_text.h"

#include <qpdf/Pipeline.hh>
#include <stdexcept>
#include <vector>

namespace telestrain {
namespace {

// Takes bytes up to a limit.
class LimitedText : public Pipeline {
 public:
  explicit LimitedText(std::size_t limit) : Pipeline("limited text", nullptr), limit_(limit) {}
  void write(unsigned char const* data, std::size_t size) override {
    // Never wraps around: text_ is at most limit_ long.
    if (size > limit_ - text_.size()) throw std::runtime_error("a stream of it is too long");
    text_.append(reinterpret_cast<const char*>(data), size);
  }
  void finish() override {}
  std::string& text() { return text_; }

 private:
  std::size_t limit_;
  std::string text_;
};

std::string ContentOf(QPDFObjectHandle page, std::size_t limit) {
  QPDFObjectHandle contents = page.getKey("/Contents");
  std::string bytes;
  const std::vector<QPDFObjectHandle> streams =
      contents.isArray() ? contents.getArrayAsVector() : std::vector{contents};
  for (QPDFObjectHandle stream : streams) {
    if (!stream.isStream()) continue;
    bytes += StreamBytes(stream, limit - bytes.size());
    if (bytes.size() >= limit) throw std::runtime_error("the pages of it are too long");
    bytes += "\n";
  }
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

PageText ReadPage(QPDF& pdf, QPDFObjectHandle page, std::size_t& limit) {
  const std::string content = ContentOf(page, limit);
  limit -= content.size();
  const PageDrawing drawing = ReadDrawing(pdf, page, content);
  PageText read;
  for (const TextPiece& piece : drawing.pieces) read.text += piece.text + "\n";
  read.hashes = PrintedHashes(drawing);
  return read;
}

}  // namespace telestrain
