#include <nlohmann/json.hpp>

#include "measurement/estimate_json.h"
#include "measurement/sequence_statistics.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

template <typename T, typename ToJson>
Json OrNull(const std::optional<T>& value, const ToJson& to_json) {
  return value ? to_json(*value) : Json(nullptr);
}

Json OrNull(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

// Every estimate of one result with the same coverage factor.
struct Writer {
  double k;

  Json operator()(const Estimate& estimate) const { return EstimateJson(estimate, k); }
  Json operator()(const GaugeRegression& regression) const {
    return {{"count", regression.count},
            {"slope", (*this)(regression.line.slope)},
            {"intercept_microstrain", (*this)(regression.line.intercept)},
            {"chi2", regression.line.chi2},
            {"degrees_of_freedom", regression.line.degrees_of_freedom},
            {"scatters_more_than_stated", regression.line.scatters_more_than_stated},
            {"bias_microstrain", (*this)(regression.bias)},
            {"residual_rms_microstrain", regression.residual_rms},
            {"max_abs_residual_microstrain", regression.max_abs_residual}};
  }
  Json operator()(const Hysteresis& hysteresis) const {
    return {{"count", hysteresis.count},
            {"largest_microstrain", (*this)(hysteresis.largest)},
            {"at_microstrain", hysteresis.at_microstrain},
            {"mean_microstrain", (*this)(hysteresis.mean)}};
  }
  Json operator()(const CycleStatistics& cycle) const {
    return {{"cycle", cycle.cycle},
            {"regression", OrNull(cycle.regression, *this)},
            {"hysteresis", OrNull(cycle.hysteresis, *this)},
            {"zero_microstrain", OrNull(cycle.zero, *this)}};
  }
  Json operator()(const NoiseFloor& floor) const {
    return {{"count", floor.count},
            {"mean_microstrain", (*this)(floor.mean)},
            {"sd_microstrain", floor.count > 1 ? Json(floor.sd) : Json(nullptr)},
            {"max_abs_microstrain", floor.max_abs},
            {"stated_sd_microstrain", floor.stated_sd},
            {"largest_motion_mm", floor.largest_motion_mm}};
  }
  Json operator()(const Repeatability& repeatability) const {
    return {{"steps", repeatability.groups},
            {"sd_microstrain", repeatability.sd},
            {"degrees_of_freedom", repeatability.degrees_of_freedom},
            {"stated_sd_microstrain", repeatability.stated_sd}};
  }
  Json operator()(const WarmUp& warm_up) const {
    return {{"zero_states", warm_up.count},
            {"window_s", warm_up.window_s},
            {"drift_microstrain_per_10_min", OrNull(warm_up.drift_per_10_min, *this)},
            {"still_drifting", warm_up.still_drifting},
            {"settled_since_s", OrNull(warm_up.settled_since_s)},
            {"time_constant_s", OrNull(warm_up.time_constant_s, *this)},
            {"printed", warm_up.sentence}};
  }
  Json operator()(const ExtensometerClass& result) const {
    const auto name_or_null = [](const std::string& name) {
      return name.empty() ? Json(nullptr) : Json(name);
    };
    return {{"standard", result.standard},
            {"class", name_or_null(result.name)},
            {"class_with_uncertainty", name_or_null(result.proven)},
            {"unit", result.unit},
            {"count", result.count},
            {"range", result.range},
            {"worst_image", result.worst_image},
            {"worst_error", result.worst_error},
            {"worst_limit", result.worst_limit},
            {"resolution", OrNull(result.resolution)},
            {"resolution_limit", OrNull(result.resolution_limit)},
            {"not_covered", result.not_covered}};
  }
};

}  // namespace

nlohmann::ordered_json SequenceJson(const SequenceStatistics& statistics,
                                    const std::vector<SequenceState>& states,
                                    double coverage_factor) {
  const Writer write{coverage_factor};
  Json cycles = Json::array(), residuals = Json::array(), zero_states = Json::array();
  for (const CycleStatistics& cycle : statistics.cycles) cycles.push_back(write(cycle));
  for (const auto& residual : statistics.residuals) residuals.push_back(OrNull(residual));
  for (const std::size_t i : statistics.zero_states) zero_states.push_back(states[i].image);
  return {
      {"coverage_factor", coverage_factor},
      {"regression", OrNull(statistics.regression, write)},
      {"residuals_microstrain", residuals},
      {"cycles", cycles},
      {"zero_states", zero_states},
      {"drift_microstrain_per_hour", OrNull(statistics.drift_per_hour, write)},
      {"largest_change_between_cycles_microstrain", OrNull(statistics.largest_cycle_change, write)},
      {"repeatability", OrNull(statistics.repeatability, write)},
      {"noise_floor_still", OrNull(statistics.still, write)},
      {"noise_floor_moved", OrNull(statistics.moved, write)},
      {"warm_up", write(statistics.warm_up)},
      {"iso9513", OrNull(statistics.iso9513, write)},
      {"astm_e83", OrNull(statistics.astm_e83, write)}};
}

}  // namespace telestrain
