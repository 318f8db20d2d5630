#pragma once

#include <string>

#include "base/result.h"
#include "report/json_lookup.h"

namespace telestrain {

// The layout of a report as its user wrote it: acceptance.json, schema "telestrain.template/1".
// templates/README.md explains every key.
//
// Texts may hold {{…}}: JSON pointers into results.json, tried in turn, and at the end a text, as
// in
// "{{/document/number|/document/report_number|without number}}".
class ReportTemplate {
 public:
  // Checks everything a layout can get wrong before anything is drawn. Fails (kBadInput) with
  // `name`, the JSON pointer of the entry, what was found, and the nearest known word.
  static Result<ReportTemplate> Parse(const std::string& name, const std::string& text);
  // The layout that was compiled in.
  static Result<ReportTemplate> BuiltIn();

  const Json& blocks() const { return json_["blocks"]; }
  const Json& json() const { return json_; }
  // The user's wording for a text of results.json, or the text itself.
  std::string Translate(const std::string& text) const;

 private:
  Json json_;
};

// `text` with its {{…}} replaced from `values`.
std::string FillIn(const std::string& text, const Json& values);

// The text of templates/acceptance.json, generated at build time.
extern const char* const kBuiltInTemplate;

}  // namespace telestrain
