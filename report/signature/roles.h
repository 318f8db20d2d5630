#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace telestrain {

// Who signs a report: the instrument seals it first, then each person once. The names of the
// signature fields.
inline constexpr std::array<std::string_view, 4> kSigningRoles = {"instrument", "operator",
                                                                  "reviewer", "approver"};
inline constexpr std::string_view kSealingRole = kSigningRoles[0];

inline bool IsSigningRole(std::string_view name) {
  return std::find(kSigningRoles.begin(), kSigningRoles.end(), name) != kSigningRoles.end();
}

}  // namespace telestrain
