#pragma once

#include <nlohmann/json_fwd.hpp>

#include "measurement/estimate.h"

namespace telestrain {

// {value, standard_uncertainty, degrees_of_freedom (null: known), expanded_uncertainty}.
nlohmann::ordered_json EstimateJson(const Estimate& estimate, double coverage_factor);

}  // namespace telestrain
