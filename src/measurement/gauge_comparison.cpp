#include "measurement/gauge_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numbers.h"

namespace telestrain {
namespace {

constexpr double kOutlier_sigmas = 4;
constexpr std::size_t kFewestGauges = 3, kFewestLoadedStates = 3;

std::optional<double> ChangeOf(const PipeState& reference, const PipeState& state,
                               std::size_t gauge) {
  // A state that came while watching may stand in no table.
  if (gauge >= std::min(state.gauges_microstrain.size(), reference.gauges_microstrain.size()))
    return {};
  if (!state.gauges_microstrain[gauge] || !reference.gauges_microstrain[gauge]) return {};
  return *state.gauges_microstrain[gauge] - *reference.gauges_microstrain[gauge];
}

// The deviation of one gauge from its proportion to others, in one state.
struct Deviation {
  std::size_t gauge = 0;
  double value = 0, sigma = 0;
  double Sigmas() const { return std::abs(value) / sigma; }
};

// Gauges of the states in which all of them read, as changes since the reference.
struct GaugeTable {
  std::vector<std::size_t> rows;             // of session.pipe_states
  std::vector<std::vector<double>> changes;  // per row, one per gauge
  std::vector<double> sigmas;                // of one reading, per gauge

  double MeanOfOthers(std::size_t row, std::size_t gauge,
                      const std::vector<std::size_t>& among) const {
    double sum = 0;
    for (const std::size_t other : among)
      if (other != gauge) sum += changes[row][other];
    return sum / static_cast<double>(among.size() - 1);
  }
};

// The gauge's change over the mean change of the others: the median over the states in which the
// others changed by more than their noise. Nothing when these are too few.
std::optional<double> Proportion(const GaugeTable& table, std::size_t gauge,
                                 const std::vector<std::size_t>& among) {
  std::vector<double> ratios;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double others = table.MeanOfOthers(row, gauge, among);
    if (std::abs(others) > kOutlier_sigmas * table.sigmas[gauge])
      ratios.push_back(table.changes[row][gauge] / others);
  }
  if (ratios.size() < kFewestLoadedStates) return {};
  return Median(ratios);
}

std::optional<Deviation> DeviationOf(const GaugeTable& table, std::size_t row, std::size_t gauge,
                                     const std::vector<std::size_t>& among) {
  const auto proportion = Proportion(table, gauge, among);
  if (!proportion) return {};
  double others = 0;
  for (const std::size_t other : among)
    if (other != gauge) others += std::pow(table.sigmas[other], 2);
  others *= std::pow(*proportion / static_cast<double>(among.size() - 1), 2);
  const double change_variance = 2 * (std::pow(table.sigmas[gauge], 2) + others);
  return Deviation{gauge,
                   table.changes[row][gauge] - *proportion * table.MeanOfOthers(row, gauge, among),
                   std::sqrt(change_variance)};
}

// The gauge that is furthest off in one state, if any is beyond the limit.
std::optional<Deviation> Worst(const GaugeTable& table, std::size_t row,
                               const std::vector<std::size_t>& among) {
  std::optional<Deviation> worst;
  for (const std::size_t gauge : among) {
    const auto deviation = DeviationOf(table, row, gauge, among);
    if (!deviation || deviation->Sigmas() <= kOutlier_sigmas) continue;
    if (!worst || deviation->Sigmas() > worst->Sigmas()) worst = deviation;
  }
  return worst;
}

std::optional<GaugeTable> TableOf(const Session& session) {
  GaugeTable table;
  for (const auto& sigma : GaugeSigmas_microstrain(session)) {
    if (!sigma || *sigma <= 0) return {};
    table.sigmas.push_back(*sigma);
  }
  for (std::size_t row = 1; row < session.pipe_states.size(); ++row) {
    std::vector<double> changes;
    for (std::size_t gauge = 0; gauge < table.sigmas.size(); ++gauge)
      if (const auto change = ChangeOf(session.pipe_states[0], session.pipe_states[row], gauge))
        changes.push_back(*change);
    if (changes.size() != table.sigmas.size()) continue;
    table.rows.push_back(row);
    table.changes.push_back(std::move(changes));
  }
  return table;
}

}  // namespace

std::optional<double> MeanOfGauges(const PipeState& state) {
  double sum = 0;
  int count = 0;
  for (const auto& gauge : state.gauges_microstrain) {
    if (!gauge) continue;
    sum += *gauge;
    ++count;
  }
  if (count == 0) return {};
  return sum / count;
}

std::optional<double> ChangeOfGauges(const PipeState& reference, const PipeState& state) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < state.gauges_microstrain.size(); ++i) {
    const auto change = ChangeOf(reference, state, i);
    if (!change) continue;
    sum += *change;
    ++count;
  }
  if (count == 0) return {};
  return sum / count;
}

std::optional<double> SigmaOfGauges(const PipeState& reference, const PipeState& state,
                                    const std::vector<std::optional<double>>& sigmas_microstrain) {
  double variances = 0;
  int count = 0;
  for (std::size_t i = 0; i < state.gauges_microstrain.size(); ++i) {
    if (!ChangeOf(reference, state, i)) continue;
    if (i >= sigmas_microstrain.size() || !sigmas_microstrain[i]) return {};
    variances += std::pow(*sigmas_microstrain[i], 2);
    ++count;
  }
  if (count == 0) return {};
  return std::sqrt(variances) / count;
}

ComparedStrain ComparedWithGauges(const StateStrain& strain,
                                  const std::vector<std::string>& gauge_columns,
                                  const PipeState& reference, const PipeState& state) {
  const ComparedStrain long_base{strain.axial_strain, strain.standard_uncertainty, false};
  ComparedStrain mean;
  int count = 0;
  for (std::size_t i = 0; i < gauge_columns.size(); ++i) {
    if (!ChangeOf(reference, state, i)) continue;
    const auto place =
        std::find_if(strain.gauges.begin(), strain.gauges.end(),
                     [&](const GaugeStrain& gauge) { return gauge.column == gauge_columns[i]; });
    if (place == strain.gauges.end()) return long_base;
    mean.strain += place->strain.value;
    mean.standard_uncertainty += place->strain.standard_uncertainty;
    ++count;
  }
  if (count == 0) return long_base;
  return {mean.strain / count, mean.standard_uncertainty / count, true};
}

std::vector<std::optional<double>> GaugeSigmas_microstrain(const Session& session) {
  std::vector<std::optional<double>> sigmas(session.gauge_columns.size(),
                                            session.pipe.sigma_gauge_microstrain);
  for (const PipeGauge& gauge : session.pipe.gauges) {
    const auto column =
        std::find(session.gauge_columns.begin(), session.gauge_columns.end(), gauge.column);
    if (column != session.gauge_columns.end() && gauge.sigma_microstrain > 0)
      sigmas[static_cast<std::size_t>(column - session.gauge_columns.begin())] =
          gauge.sigma_microstrain;
  }
  return sigmas;
}

std::optional<GaugeComparison> CompareWithGauges(const std::vector<SequenceState>& states) {
  std::vector<std::pair<double, double>> pairs;  // gauge, camera
  double camera_variances = 0, gauge_variances = 0;
  bool gauges_known = true;
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (!states[i].gauge_microstrain) continue;
    pairs.emplace_back(*states[i].gauge_microstrain, states[i].camera_microstrain);
    camera_variances += std::pow(states[i].camera_sigma_microstrain, 2);
    gauges_known = gauges_known && states[i].gauge_sigma_microstrain.has_value();
    gauge_variances += 2 * std::pow(states[i].gauge_sigma_microstrain.value_or(0), 2);
  }
  if (pairs.empty()) return {};
  GaugeComparison comparison;
  comparison.count = static_cast<int>(pairs.size());
  const double count = static_cast<double>(pairs.size());
  comparison.standard_uncertainty_microstrain = std::sqrt(camera_variances / count);
  if (gauges_known)
    comparison.error_uncertainty_microstrain =
        std::sqrt((camera_variances + gauge_variances) / count);
  double gauge_mean = 0, camera_mean = 0, squares = 0;
  for (const auto& [gauge, camera] : pairs) {
    const double error = camera - gauge;
    squares += error * error;
    comparison.mean_error_microstrain += error / count;
    comparison.max_abs_error_microstrain =
        std::max(comparison.max_abs_error_microstrain, std::abs(error));
    gauge_mean += gauge / count;
    camera_mean += camera / count;
  }
  comparison.rms_error_microstrain = std::sqrt(squares / count);
  double xx = 0, xy = 0;
  for (const auto& [gauge, camera] : pairs) {
    xx += (gauge - gauge_mean) * (gauge - gauge_mean);
    xy += (gauge - gauge_mean) * (camera - camera_mean);
  }
  comparison.slope = xx > 0 ? xy / xx : std::numeric_limits<double>::quiet_NaN();
  comparison.intercept_microstrain = camera_mean - comparison.slope * gauge_mean;
  return comparison;
}

std::vector<GaugeOutlier> FindGaugeOutliers(const Session& session) {
  std::vector<GaugeOutlier> outliers;
  const auto table = TableOf(session);
  if (!table || table->sigmas.size() < kFewestGauges) return outliers;
  std::vector<std::size_t> all;
  for (std::size_t gauge = 0; gauge < table->sigmas.size(); ++gauge) all.push_back(gauge);
  for (std::size_t row = 0; row < table->rows.size(); ++row) {
    const auto worst = Worst(*table, row, all);
    if (!worst) continue;
    std::vector<std::size_t> others = all;
    std::erase(others, worst->gauge);
    if (Worst(*table, row, others)) continue;
    outliers.push_back({session.gauge_columns[worst->gauge],
                        session.pipe_states[table->rows[row]].image, worst->value, worst->sigma});
  }
  return outliers;
}

}  // namespace telestrain
