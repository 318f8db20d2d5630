#include "report/dcc/dcc_xml.h"

#include <libxml/xmlwriter.h>

#include "report/unicode_text.h"

namespace telestrain {
namespace {

const xmlChar* Chars(const std::string& text) {
  return reinterpret_cast<const xmlChar*>(text.c_str());
}

// XML 1.0, production 2, without the C1 controls that it discourages.
bool IsXmlChar(char32_t c) {
  if (c < 0x20 || (c >= 0x7F && c < 0xA0)) return false;
  return c < 0xD800 || (c >= 0xE000 && c < 0xFFFE) || (c >= 0x10000 && c <= 0x10FFFF);
}

bool IsBlank(char32_t c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

std::string XmlText(const std::string& utf8) {
  std::string text;
  bool blank = false;
  for (const char32_t c : CodePoints(utf8)) {
    if (IsBlank(c)) {
      blank = true;
      continue;
    }
    if (!IsXmlChar(c)) continue;
    if (blank && !text.empty()) text += ' ';
    blank = false;
    text += Utf8(c);
  }
  return text;
}

struct DccXml::Parts {
  std::unique_ptr<xmlBuffer, decltype(&xmlBufferFree)> buffer{xmlBufferCreate(), &xmlBufferFree};
  std::unique_ptr<xmlTextWriter, decltype(&xmlFreeTextWriter)> writer{
      xmlNewTextWriterMemory(buffer.get(), 0), &xmlFreeTextWriter};
  bool ok = buffer && writer;
};

DccXml::DccXml() : parts_(std::make_unique<Parts>()) {
  if (!parts_->ok) return;
  Check(xmlTextWriterSetIndent(parts_->writer.get(), 1));
  Check(xmlTextWriterStartDocument(parts_->writer.get(), nullptr, "UTF-8", nullptr));
}

DccXml::~DccXml() = default;

void DccXml::Check(int written) { parts_->ok = parts_->ok && written >= 0; }

DccXml::Element DccXml::Open(const std::string& name, const Attributes& attributes) {
  if (parts_->ok) Check(xmlTextWriterStartElement(parts_->writer.get(), Chars(name)));
  for (const auto& [key, value] : attributes)
    if (parts_->ok)
      Check(xmlTextWriterWriteAttribute(parts_->writer.get(), Chars(key), Chars(XmlText(value))));
  return Element(this);
}

void DccXml::Close() {
  if (parts_->ok) Check(xmlTextWriterEndElement(parts_->writer.get()));
}

void DccXml::Leaf(const std::string& name, const std::string& text, const Attributes& attributes) {
  const std::string clean = XmlText(text);
  if (clean.empty()) return;
  const Element element = Open(name, attributes);
  if (parts_->ok) Check(xmlTextWriterWriteString(parts_->writer.get(), Chars(clean)));
}

void DccXml::Text(const std::string& name, const std::string& text, const Attributes& attributes) {
  if (XmlText(text).empty()) return;
  const Element element = Open(name, attributes);
  Leaf("dcc:content", text, {{"lang", "en"}});
}

void DccXml::GivenText(const std::string& name, const std::string& text) {
  if (XmlText(text).empty()) return;
  const Element element = Open(name);
  Leaf("dcc:content", text);
}

Result<std::string> DccXml::Finish() {
  if (parts_->ok) Check(xmlTextWriterEndDocument(parts_->writer.get()));
  if (!parts_->ok) return OutputFailed("dcc.xml: libxml2 could not write the document");
  parts_->writer.reset();  // flushes into the buffer
  return std::string(reinterpret_cast<const char*>(xmlBufferContent(parts_->buffer.get())),
                     static_cast<std::size_t>(xmlBufferLength(parts_->buffer.get())));
}

}  // namespace telestrain
