#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "report/page_flow.h"
#include "report/report_template.h"

namespace telestrain {

// What the blocks of one report draw from.
struct ReportContext {
  std::filesystem::path folder;  // the results folder
  const ReportTemplate& layout;
  const Json& results;  // results.json, its tables in the report's language
  const Json& values;   // what the {{…}} of texts can name
  PageFlow& flow;

  std::string Fill(const Json& block, const char* key) const {
    return layout.Fill(TextAt(block, std::string("/") + key), values);
  }
  const Json& Table(const std::string& id) const {
    return FindBy(ListAt(results, "/tables"), "id", id);
  }
};

// Draws one block; `pointer` is its JSON pointer in the layout, for errors. Fails (kBadInput) when
// a picture or a table that a chart reads is malformed.
Status DrawBlock(const ReportContext& context, const std::string& pointer, const Json& block);

// Headers and footers of all pages, after the last one is known.
void DrawPageFrames(const ReportContext& context);

}  // namespace telestrain
