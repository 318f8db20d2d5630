#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "correlation/pattern_assessment.h"

namespace telestrain {

// The assessment in lines for a person: the pattern, what is recommended with it, what may be
// improved. `subset_px` and `step_px` are those that are used.
std::vector<std::string> PatternLines(const PatternAssessment& pattern, int subset_px, int step_px);

// The same for a program (keys with units).
nlohmann::ordered_json PatternJson(const PatternAssessment& pattern);

}  // namespace telestrain
