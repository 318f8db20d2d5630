#include <nlohmann/json.hpp>

#include "measurement/estimate_json.h"
#include "measurement/ruler_acceptance.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

Json DecisionJson(const RulerDecision& decision, const RulerLength& length) {
  const RulerPose& pose = decision.pose;
  Json budget = Json::array();
  for (const BudgetLine& line : length.budget)
    budget.push_back(
        {{"source", line.source}, {"standard_uncertainty_um", line.standard_uncertainty}});
  Json json{{"image", length.image},
            {"middle_in_array_mm", {pose.middle_mm.x(), pose.middle_mm.y(), pose.middle_mm.z()}},
            {"depth_mm", pose.depth_mm},
            {"yaw_deg", pose.yaw_deg},
            {"pitch_deg", pose.pitch_deg},
            {"expanded_uncertainty_um", decision.expanded_uncertainty_um},
            {"verdict", nullptr},
            {"margin_um", nullptr},
            {"printed", nullptr},
            {"budget", budget}};
  if (!decision.decision) return json;
  json["verdict"] = VerdictName(decision.decision->verdict);
  json["margin_um"] = decision.decision->margin;
  json["printed"] = decision.decision->words;
  return json;
}

Json TrendJson(const ErrorTrend& trend, double coverage_factor) {
  return {{"on", trend.on},
          {"unit", trend.unit},
          {"slope", EstimateJson(trend.slope, coverage_factor)},
          {"range", trend.range},
          {"effect_um", EstimateJson(trend.effect_um, coverage_factor)},
          {"significant", trend.significant}};
}

}  // namespace

nlohmann::ordered_json RulerAcceptanceJson(const RulerAcceptance& acceptance,
                                           const std::vector<RulerLength>& lengths,
                                           double coverage_factor) {
  Json images = Json::array(), worst = Json::array(), trends = Json::array();
  for (const RulerDecision& decision : acceptance.decisions)
    images.push_back(DecisionJson(decision, lengths[decision.length]));
  for (const std::size_t i : acceptance.worst)
    worst.push_back(lengths[acceptance.decisions[i].length].image);
  for (const ErrorTrend& trend : acceptance.trends)
    trends.push_back(TrendJson(trend, coverage_factor));
  const RulerRepeatability& repeatability = acceptance.repeatability;
  return {{"coverage_factor", coverage_factor},
          {"mpe_um", acceptance.mpe_um ? Json(*acceptance.mpe_um) : Json(nullptr)},
          {"images", images},
          {"worst", worst},
          {"trends", trends},
          {"bias_um", EstimateJson(acceptance.bias_um, coverage_factor)},
          {"spread_um", EstimateJson(acceptance.spread_um, coverage_factor)},
          {"stated_spread_um", acceptance.stated_spread_um},
          {"repeatability",
           {{"sd_um", repeatability.sd_um},
            {"degrees_of_freedom", repeatability.degrees_of_freedom},
            {"method", repeatability.method}}},
          {"printed_count", acceptance.count_sentence},
          {"not_in_budget", acceptance.not_in_budget}};
}

}  // namespace telestrain
