#pragma once

#include <array>
#include <vector>

#include "report/audit/audit_trail.h"

namespace telestrain {

// Options that say where a verb writes.
inline constexpr std::array kWritingOptions = {"out", "turntable", "states", "dcc"};

// Whether the steps of a trail may be run again in a folder made for that. A trail is a file that
// anybody may have written: all of its paths and places must lie inside (LiesInside), an option
// must be one option with its values, named as telestrain names them. Fails (kBadInput) with the
// line and what it names.
Status CheckRepeatable(const std::vector<AuditEntry>& entries);

}  // namespace telestrain
