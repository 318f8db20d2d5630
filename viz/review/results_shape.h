#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"

namespace telestrain::viz {

// Whether results.json holds what the page reads of it, each of its kind: verdict, title, document,
// decision, quantities and tables, whose rows have a cell for every column. Fails (kBadInput) with
// `file`, the field, what was found there and the command that makes the file again.
Status RequireResultsShape(const nlohmann::ordered_json& results, const std::string& file);

}  // namespace telestrain::viz
