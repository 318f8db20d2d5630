#include "measurement/estimate_json.h"

#include <nlohmann/json.hpp>

namespace telestrain {

nlohmann::ordered_json EstimateJson(const Estimate& estimate, double coverage_factor) {
  using Json = nlohmann::ordered_json;
  return {{"value", estimate.value},
          {"standard_uncertainty", estimate.standard_uncertainty},
          {"degrees_of_freedom",
           estimate.degrees_of_freedom > 0 ? Json(estimate.degrees_of_freedom) : Json(nullptr)},
          {"expanded_uncertainty", ExpandedUncertainty(estimate, coverage_factor)}};
}

}  // namespace telestrain
