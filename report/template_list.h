#pragma once

#include <string>
#include <vector>

#include "report/acceptance_report.h"

namespace telestrain {

struct NamedTemplate {
  std::string name, title;  // "acceptance", "Acceptance report"; "de", "Deutsch"
};
struct TemplateList {
  std::vector<NamedTemplate> layouts, languages;
};
// The layouts and languages that a report can have: built-in ones and those of the user's folder,
// sorted by name. Fails (kBadInput) for a malformed file of the folder.
Result<TemplateList> ListTemplates(const std::filesystem::path& folder);

struct LayoutScope {
  ReportScope scope;             // without the earlier results
  bool against_earlier = false;  // the layout needs them
};
// What the layout of `options` says of its content. Fails as ReportTemplate::Load.
Result<LayoutScope> ScopeOfLayout(const ReportOptions& options);

}  // namespace telestrain
