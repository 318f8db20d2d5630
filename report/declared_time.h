#pragma once

#include <string>

#include "report/json_lookup.h"

namespace telestrain {

// When the results say that they were made, ISO 8601 as given: `date` of the session's [document],
// else the environment's SOURCE_DATE_EPOCH (seconds since 1970, UTC), else empty. Never the clock:
// the same input gives the same bytes.
std::string DeclaredTime(const Json& document);

}  // namespace telestrain
