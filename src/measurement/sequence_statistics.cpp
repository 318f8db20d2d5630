#include "measurement/sequence_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "measurement/sequence_readings.h"

namespace telestrain {
namespace {

using Readings = std::vector<SequenceReading>;

bool IsZero(const SequenceState& state, const SequenceState& reference, double coverage_factor) {
  if (!state.gauge_microstrain || !state.gauge_sigma_microstrain)
    return !state.step.empty() && state.step == reference.step;  // no label says nothing
  // Both readings of the change are uncertain.
  return std::abs(*state.gauge_microstrain) <=
         coverage_factor * std::sqrt(2.0) * *state.gauge_sigma_microstrain;
}

// Mean of the errors of `readings`; the reference's own uncertainty is common to all.
Estimate MeanError(const Readings& readings, double reference_sigma) {
  double sum = 0, variances = 0;
  for (const SequenceReading& reading : readings) {
    sum += reading.Error();
    variances += std::pow(reading.ErrorSigma(), 2);
  }
  const double count = static_cast<double>(readings.size());
  return {sum / count, std::hypot(std::sqrt(variances) / count, reference_sigma), 0};
}

// `readings` have gauges. The intercept is that of changes since the reference: where the reference
// is among the points, its noise is in the line and in the zero of both axes, and partly cancels:
// var = 1 / W - sigma^2 with W its weight and sigma the intercept's of independent points.
std::optional<GaugeRegression> Regress(const Readings& readings, const SequenceReading& reference) {
  std::vector<LinePoint> points;
  bool holds_reference = false;
  Readings changes;
  for (const SequenceReading& reading : readings) {
    points.push_back(reading.Point());
    holds_reference = holds_reference || reading.state == reference.state;
    if (reading.state != reference.state) changes.push_back(reading);
  }
  auto line = FitLine(points);
  if (!line || changes.empty()) return {};
  GaugeRegression regression;
  const double inflation =
      line->scatters_more_than_stated ? line->chi2 / line->degrees_of_freedom : 1;
  const double of_reference = inflation * (std::pow(reference.camera_sigma, 2) +
                                           std::pow(line->slope.value * reference.gauge_sigma, 2));
  const double of_line = std::pow(line->intercept.standard_uncertainty, 2);
  line->intercept.standard_uncertainty =
      std::sqrt(std::max(0.0, holds_reference ? of_reference - of_line : of_reference + of_line));
  regression.line = *line;
  regression.count = static_cast<int>(changes.size());
  regression.bias = MeanError(changes, reference.ErrorSigma());
  double squares = 0;
  for (const SequenceReading& reading : changes) {
    const double residual = reading.camera - line->At(*reading.gauge);
    squares += residual * residual;
    regression.max_abs_residual = std::max(regression.max_abs_residual, std::abs(residual));
  }
  regression.residual_rms = std::sqrt(squares / regression.count);
  return regression;
}

Readings WithGauges(const Readings& readings) {
  Readings with;
  for (const SequenceReading& reading : readings)
    if (reading.gauge) with.push_back(reading);
  return with;
}

// The error of the loading branch at `gauge`, between the two of its readings around it; the sigma
// is that of the interpolation.
std::optional<Estimate> LoadingError(const Readings& loading, double gauge) {
  for (std::size_t i = 1; i < loading.size(); ++i) {
    const double low = *loading[i - 1].gauge, high = *loading[i].gauge;
    if (low == high || (gauge - low) * (gauge - high) > 0) continue;
    const double share = (gauge - low) / (high - low);
    return Estimate{
        (1 - share) * loading[i - 1].Error() + share * loading[i].Error(),
        std::hypot((1 - share) * loading[i - 1].ErrorSigma(), share * loading[i].ErrorSigma()), 0};
  }
  return {};
}

// `cycle` begins with the state before its first load.
std::optional<Hysteresis> HysteresisOf(const Readings& cycle) {
  if (cycle.size() < 3) return {};
  const auto peak = std::max_element(cycle.begin(), cycle.end(), [&](const auto& a, const auto& b) {
    return std::abs(*a.gauge - *cycle[0].gauge) < std::abs(*b.gauge - *cycle[0].gauge);
  });
  const Readings loading(cycle.begin(), peak + 1);
  Hysteresis hysteresis;
  double variances = 0;
  for (auto reading = peak + 1; reading != cycle.end(); ++reading) {
    const auto at_loading = LoadingError(loading, *reading->gauge);
    if (!at_loading) continue;
    const double difference = reading->Error() - at_loading->value;
    const double sigma = std::hypot(reading->ErrorSigma(), at_loading->standard_uncertainty);
    ++hysteresis.count;
    hysteresis.mean.value += difference;
    variances += sigma * sigma;
    if (hysteresis.count > 1 && std::abs(difference) <= std::abs(hysteresis.largest.value))
      continue;
    hysteresis.largest = {difference, sigma, 0};
    hysteresis.at_microstrain = *reading->gauge;
  }
  if (hysteresis.count == 0) return {};
  hysteresis.mean.value /= hysteresis.count;
  hysteresis.mean.standard_uncertainty = std::sqrt(variances) / hysteresis.count;
  return hysteresis;
}

std::vector<CycleStatistics> Cycles(const std::vector<SequenceState>& states,
                                    const Readings& readings,
                                    const std::vector<std::size_t>& zero_states) {
  std::vector<CycleStatistics> cycles;
  for (std::size_t first = 0, end = 0; first < states.size(); first = end) {
    CycleStatistics statistics;
    statistics.cycle = states[first].cycle;
    Readings all, zeros;
    for (end = first; end < states.size() && states[end].cycle == statistics.cycle; ++end) {
      all.push_back(readings[end]);
      if (std::find(zero_states.begin(), zero_states.end(), end) != zero_states.end())
        zeros.push_back(readings[end]);
    }
    Readings with_gauges = WithGauges(all);
    statistics.regression = Regress(with_gauges, readings[0]);
    if (first > 0 && readings[first - 1].gauge)
      with_gauges.insert(with_gauges.begin(), readings[first - 1]);
    statistics.hysteresis = HysteresisOf(with_gauges);
    if (!zeros.empty()) statistics.zero = MeanError(zeros, readings[0].ErrorSigma());
    cycles.push_back(std::move(statistics));
  }
  return cycles;
}

// Between means of zero states the reference's noise cancels.
std::optional<Estimate> LargestCycleChange(const std::vector<CycleStatistics>& cycles,
                                           double reference_sigma) {
  std::optional<Estimate> largest;
  const auto own_variance = [&](const Estimate& zero) {
    return std::pow(zero.standard_uncertainty, 2) - reference_sigma * reference_sigma;
  };
  for (std::size_t i = 0; i < cycles.size(); ++i)
    for (std::size_t j = i + 1; j < cycles.size(); ++j) {
      if (!cycles[i].zero || !cycles[j].zero) continue;
      const double change = cycles[j].zero->value - cycles[i].zero->value;
      if (largest && std::abs(change) <= std::abs(largest->value)) continue;
      largest = Estimate{
          change, std::sqrt(own_variance(*cycles[i].zero) + own_variance(*cycles[j].zero)), 0};
    }
  return largest;
}

// Errors at steps that came back, pooled. Without gauges only the reference's step is known to have
// had the same load.
std::optional<Repeatability> RepeatabilityOf(const std::vector<SequenceState>& states,
                                             const Readings& readings) {
  std::map<std::string, Readings> by_step;
  for (const SequenceReading& reading : readings)
    if (reading.state > 0 && !states[reading.state].step.empty() &&
        (reading.gauge || states[reading.state].step == states[0].step))
      by_step[states[reading.state].step].push_back(reading);
  Repeatability repeatability;
  double squares = 0, variances = 0;
  for (const auto& [step, group] : by_step) {
    if (group.size() < 2) continue;
    double mean = 0;
    for (const SequenceReading& reading : group)
      mean += reading.Error() / static_cast<double>(group.size());
    const double share = static_cast<double>(group.size() - 1) / static_cast<double>(group.size());
    for (const SequenceReading& reading : group) {
      squares += std::pow(reading.Error() - mean, 2);
      variances += share * std::pow(reading.ErrorSigma(), 2);
    }
    ++repeatability.groups;
    repeatability.degrees_of_freedom += static_cast<int>(group.size()) - 1;
  }
  if (repeatability.groups == 0) return {};
  repeatability.sd = std::sqrt(squares / repeatability.degrees_of_freedom);
  repeatability.stated_sd = std::sqrt(variances / repeatability.degrees_of_freedom);
  return repeatability;
}

// How far the rigid motion carried either patch, at half the base length from the middle.
double Motion_mm(const SequenceState& state, double base_length_mm) {
  return state.translation_mm.norm() + 0.5 * base_length_mm * state.rotation_rad.norm();
}

std::optional<NoiseFloor> FloorOf(const std::vector<SequenceState>& states,
                                  const Readings& readings, const SequenceOptions& options,
                                  const std::vector<std::size_t>& of) {
  if (of.empty()) return {};
  NoiseFloor floor;
  floor.count = static_cast<int>(of.size());
  double variances = 0;
  for (const std::size_t i : of) {
    floor.mean.value += readings[i].camera / floor.count;
    variances += std::pow(readings[i].camera_sigma, 2);
    floor.max_abs = std::max(floor.max_abs, std::abs(readings[i].camera));
    floor.largest_motion_mm =
        std::max(floor.largest_motion_mm, Motion_mm(states[i], options.base_length_mm));
  }
  floor.mean.standard_uncertainty =
      std::hypot(std::sqrt(variances) / floor.count, readings[0].camera_sigma);
  floor.stated_sd = std::sqrt(variances / floor.count);
  double squares = 0;
  for (const std::size_t i : of) squares += std::pow(readings[i].camera - floor.mean.value, 2);
  if (floor.count > 1) floor.sd = std::sqrt(squares / (floor.count - 1));
  return floor;
}

// Errors of the zero states over time, the reference among them.
std::vector<ZeroReading> ZeroReadings(const std::vector<SequenceState>& states,
                                      const Readings& readings,
                                      const std::vector<std::size_t>& zero_states) {
  std::vector<std::size_t> rows{0};
  rows.insert(rows.end(), zero_states.begin(), zero_states.end());
  std::vector<ZeroReading> zeros;
  for (const std::size_t i : rows)
    if (states[i].time_s)
      zeros.push_back({*states[i].time_s, readings[i].Error(), readings[i].ErrorSigma()});
  std::stable_sort(zeros.begin(), zeros.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return zeros;
}

std::optional<Estimate> DriftPerHour(const std::vector<ZeroReading>& zeros) {
  constexpr double kSecondsPerHour = 3600;
  std::vector<LinePoint> points;
  for (const ZeroReading& zero : zeros)
    points.push_back({zero.time_s / kSecondsPerHour, zero.error, 0, zero.sigma});
  const auto line = FitLine(points);
  if (!line) return {};
  return line->slope;
}

// Changes since the reference with their whole uncertainty, for the classes.
std::vector<ClassPoint> ClassPoints(const std::vector<SequenceState>& states, double k) {
  std::vector<ClassPoint> points;
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (!states[i].gauge_microstrain) continue;
    const double gauge_sigma = std::sqrt(2.0) * states[i].gauge_sigma_microstrain.value_or(0);
    points.push_back({states[i].image, states[i].camera_microstrain, *states[i].gauge_microstrain,
                      k * std::hypot(states[i].camera_sigma_microstrain, gauge_sigma)});
  }
  return points;
}

// Half the range of the camera's readings without strain, the reference's 0 among them.
std::optional<double> Resolution(const Readings& readings,
                                 const std::vector<std::size_t>& zero_states) {
  constexpr std::size_t kFewest = 3;
  if (zero_states.size() < kFewest) return {};
  double low = 0, high = 0;
  for (const std::size_t i : zero_states) {
    low = std::min(low, readings[i].camera);
    high = std::max(high, readings[i].camera);
  }
  return 0.5 * (high - low);
}

}  // namespace

SequenceStatistics AnalyseSequence(const std::vector<SequenceState>& states,
                                   const SequenceOptions& options) {
  SequenceStatistics statistics;
  if (states.empty()) return statistics;
  const Readings readings = ReadingsOf(states);
  for (std::size_t i = 1; i < states.size(); ++i)
    if (IsZero(states[i], states[0], options.coverage_factor)) statistics.zero_states.push_back(i);
  statistics.regression = Regress(WithGauges(readings), readings[0]);
  for (const SequenceReading& reading : readings)
    statistics.residuals.push_back(
        reading.gauge && statistics.regression
            ? std::optional(reading.camera - statistics.regression->line.At(*reading.gauge))
            : std::nullopt);
  statistics.cycles = Cycles(states, readings, statistics.zero_states);
  statistics.largest_cycle_change = LargestCycleChange(statistics.cycles, readings[0].ErrorSigma());
  statistics.repeatability = RepeatabilityOf(states, readings);
  const auto zeros = ZeroReadings(states, readings, statistics.zero_states);
  statistics.drift_per_hour = DriftPerHour(zeros);
  statistics.warm_up = CheckWarmUp(zeros, options.coverage_factor);
  std::vector<std::size_t> still, moved;
  for (const std::size_t i : statistics.zero_states)
    (Motion_mm(states[i], options.base_length_mm) < options.still_mm ? still : moved).push_back(i);
  statistics.still = FloorOf(states, readings, options, still);
  statistics.moved = FloorOf(states, readings, options, moved);
  const auto points = ClassPoints(states, options.coverage_factor);
  const auto resolution = Resolution(readings, statistics.zero_states);
  statistics.iso9513 = ClassifyIso9513(points, resolution, options.base_length_mm);
  statistics.astm_e83 = ClassifyAstmE83(points, resolution);
  return statistics;
}

}  // namespace telestrain
