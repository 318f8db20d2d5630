#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace telestrain {

// What XML 1.0 can hold of a text, as one line: ill-formed bytes become U+FFFD, control characters
// go, blanks and line ends become one blank, none stands at either end.
std::string XmlText(const std::string& utf8);

// Writes an indented XML document in UTF-8. The writer escapes what markup needs.
class DccXml {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  // Closes its element when it goes.
  class Element {
   public:
    explicit Element(DccXml* xml) : xml_(xml) {}
    Element(Element&& other) noexcept : xml_(std::exchange(other.xml_, nullptr)) {}
    Element& operator=(Element&&) = delete;
    ~Element() {
      if (xml_) xml_->Close();
    }

   private:
    DccXml* xml_;
  };

  DccXml();
  ~DccXml();

  [[nodiscard]] Element Open(const std::string& name, const Attributes& attributes = {});
  // An element with a text; of an empty text nothing is written.
  void Leaf(const std::string& name, const std::string& text, const Attributes& attributes = {});
  // dcc:textType or dcc:richContentType: an element whose content is the English text.
  void Text(const std::string& name, const std::string& text, const Attributes& attributes = {});
  // The same of a text that the session gave, in whatever language.
  void GivenText(const std::string& name, const std::string& text);
  // The document. Fails with kOutputFailed when libxml2 refused any part of it.
  Result<std::string> Finish();

 private:
  struct Parts;
  void Check(int written);
  void Close();

  std::unique_ptr<Parts> parts_;
};

}  // namespace telestrain
