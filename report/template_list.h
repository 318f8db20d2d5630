#pragma once

#include <set>
#include <string>
#include <vector>

#include "report/acceptance_report.h"

namespace telestrain {

struct NamedTemplate {
  std::string name, title;  // "acceptance", "Acceptance report"; "de", "Deutsch"
  std::string fault;        // why the file cannot be read; empty: it can
};
struct TemplateList {
  std::vector<NamedTemplate> layouts, languages;
};
// The layouts and languages that a report can have: built-in ones and those of the user's folder,
// sorted by name; a malformed file with its fault. Fails (kBadInput) when `folder` is none.
Result<TemplateList> ListTemplates(const std::filesystem::path& folder);

struct LayoutScope {
  ReportScope scope;               // without the earlier results
  bool against_earlier = false;    // the layout needs them
  std::set<std::string> pictures;  // file names in pictures/ that its blocks show
};
// What the layout of `options` says of its content. Fails as ReportTemplate::Load.
Result<LayoutScope> ScopeOfLayout(const ReportOptions& options);

}  // namespace telestrain
