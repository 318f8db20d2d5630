#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "report/json_lookup.h"

namespace telestrain {

// Texts with {{…}} (mustache): {{document.number}} is an entry of `values`, {{#name}}…{{/name}} is
// printed only where there is one, {{^name}}…{{/name}} only where there is none. What does not
// exist is empty, and so are null and the empty text. Nothing is escaped: the text is for a page.
std::string FillText(const std::string& text, const Json& values);

// What is wrong with the {{…}} of a text; nothing when it can be filled.
std::optional<std::string> TextFault(const std::string& text);

// A name in the {{…}} of a text.
struct TextName {
  std::string name;       // "document.number"
  bool guarded = false;   // a section of the text asks whether there is one
  bool relative = false;  // stands in {{#document}}…{{/document}}: may be an entry of that one
};
std::vector<TextName> PlacesInText(const std::string& text);

// The names in its {{…}}, each once: "document.number".
std::set<std::string> NamesInText(const std::string& text);

}  // namespace telestrain
