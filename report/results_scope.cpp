#include "report/results_scope.h"

#include <algorithm>
#include <array>

#include "base/numbers.h"

namespace telestrain {
namespace {

// Sections that may be decided, and the parts of the results that belong to them.
const std::map<std::string, std::vector<std::string>>& Sections() {
  static const std::map<std::string, std::vector<std::string>> kSections{
      {"calibration", {"calibration"}},
      {"diagnosis", {"diagnosis", "pinhole"}},
      {"ruler", {"ruler"}},
      {"strain", {"strain", "gauges", "sequence"}}};
  return kSections;
}

// A limit by its key in session.toml.
struct Limit {
  const char* key;
  const char* label;
  const char* unit;
  std::optional<double> Acceptance::*value;
};

constexpr std::array kLimits{
    Limit{"reprojection_rms_px", "Reprojection error, RMS", "px", &Acceptance::reprojection_rms_px},
    Limit{"ruler_mpe_um", "Length error E", "µm", &Acceptance::ruler_mpe_um},
    Limit{"strain_error_microstrain", "Strain error against the gauges, RMS", "µε",
          &Acceptance::strain_error_microstrain}};

const Limit* FindLimit(const std::string& key) {
  for (const Limit& limit : kLimits)
    if (key == limit.key) return &limit;
  return nullptr;
}

Error UnknownWord(const ReportScope& scope, const std::string& noun, const std::string& word,
                  const std::vector<std::string>& known) {
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
  return BadInput("layout '" + scope.name + "': " + noun + " '" + word + "' does not exist; use " +
                  names);
}

}  // namespace

Status CheckScope(const ReportScope& scope) {
  std::vector<std::string> sections, limits;
  for (const auto& [name, parts] : Sections()) sections.push_back(name);
  for (const Limit& limit : kLimits) limits.emplace_back(limit.key);
  for (const std::string& section : scope.sections)
    if (Sections().count(section) == 0) return UnknownWord(scope, "section", section, sections);
  for (const auto& [key, value] : scope.limits) {
    if (FindLimit(key) == nullptr) return UnknownWord(scope, "limit", key, limits);
    if (!(value > 0))
      return BadInput("layout '" + scope.name + "': limit '" + key + "' is " +
                      FormatShortest(value) + "; a limit is larger than 0");
  }
  return {};
}

bool IsInScope(const ReportScope& scope, const std::string& section) {
  return scope.sections.empty() ||
         std::find(scope.sections.begin(), scope.sections.end(), section) != scope.sections.end();
}

void ApplyLimits(const ReportScope& scope, ResultsDraft& draft) {
  std::vector<Json> replaced;
  for (const Limit& limit : kLimits) {
    const auto found = scope.limits.find(limit.key);
    if (found == scope.limits.end()) continue;
    auto& value = draft.acceptance.*limit.value;
    const std::map<std::string, Json> values{
        {"quantity", limit.label},
        {"limit", FormatShortest(found->second)},
        {"unit", limit.unit},
        {"session", value ? FormatShortest(*value) : std::string(kNoValue)}};
    replaced.push_back(Phrase(value ? "{{quantity}}: {{limit}} {{unit}} (session: {{session}})"
                                    : "{{quantity}}: {{limit}} {{unit}} (session: none)",
                              values));
    value = found->second;
  }
  draft.sentences["limits"] =
      replaced.empty()
          ? Json("")
          : Phrase("Limits of the layout {{layout}} are used instead of the session's. {{limits}}.",
                   {{"layout", scope.name}, {"limits", JoinPhrases(replaced, "; ")}});
}

void LeaveScope(const ReportScope& scope, ResultsDraft& draft) {
  std::erase_if(draft.quantities,
                [&](const Quantity& quantity) { return !IsInScope(scope, quantity.section); });
  for (const auto& [section, parts] : Sections())
    for (const std::string& part : parts)
      if (!IsInScope(scope, section)) draft.measured[part] = false;
}

}  // namespace telestrain
