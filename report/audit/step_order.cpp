#include "report/audit/step_order.h"

#include <algorithm>
#include <array>

#include "report/audit/audit_line.h"

namespace telestrain {
namespace {

constexpr std::array<std::string_view, 11> kOrder = {"open",   "detect",  "calibrate", "diagnose",
                                                     "verify", "measure", "render",    "results",
                                                     "report", "sign",    "review"};

struct Independent {
  std::string_view later, earlier;  // types in the order above, of which neither needs the other
};
constexpr std::array kIndependent = {
    Independent{"diagnose", "verify"}, Independent{"diagnose", "measure"},
    Independent{"verify", "measure"},  Independent{"diagnose", "render"},
    Independent{"render", "results"},  Independent{"sign", "review"}};

std::size_t Rank(const std::string& type) {
  return static_cast<std::size_t>(std::find(kOrder.begin(), kOrder.end(), type) - kOrder.begin());
}

}  // namespace

bool Supersedes(const std::string& later, const std::string& earlier) {
  if (Rank(earlier) == kOrder.size() || Rank(later) >= Rank(earlier)) return false;
  return std::none_of(kIndependent.begin(), kIndependent.end(), [&](const Independent& pair) {
    return pair.later == later && pair.earlier == earlier;
  });
}

bool IsSuperseded(const std::vector<AuditEntry>& entries, std::size_t index) {
  const auto after = entries.begin() + static_cast<std::ptrdiff_t>(index) + 1;
  return std::any_of(after, entries.end(), [&](const AuditEntry& entry) {
    return Supersedes(entry.type, entries[index].type);
  });
}

bool IsRecorded(const AuditTrail& trail, const std::string& type, const Json& body) {
  if (!trail.Repeats(type, body)) return false;
  const auto& entries = trail.entries();
  std::size_t latest = entries.size() - 1;
  while (entries[latest].type != type) --latest;
  return !IsSuperseded(entries, latest);
}

}  // namespace telestrain
