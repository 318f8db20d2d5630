#include "measurement/warm_up.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "measurement/line_fit.h"

namespace telestrain {
namespace {

constexpr double kWindow_s = 600;
constexpr std::size_t kFewest = 3;
constexpr int kTimeConstants = 400;          // tried, in equal ratios
constexpr double kSureOfApproach_chi2 = 9;   // three standard deviations against a constant
constexpr double kSureOfCurvature_chi2 = 4;  // two against a straight line
constexpr std::size_t kFewestForApproach = 5;

using Readings = std::vector<ZeroReading>;

std::optional<FittedLine> DriftOf(const Readings& zeros, std::size_t from) {
  std::vector<LinePoint> points;
  for (std::size_t i = from; i < zeros.size(); ++i)
    points.push_back({zeros[i].time_s / kWindow_s, zeros[i].error, 0, zeros[i].sigma});
  return FitLine(points);
}

Estimate WeightedMean(const Readings& zeros, std::size_t from) {
  double weights = 0, sum = 0;
  for (std::size_t i = from; i < zeros.size(); ++i) {
    const double weight = 1 / (zeros[i].sigma * zeros[i].sigma);
    weights += weight;
    sum += weight * zeros[i].error;
  }
  return {sum / weights, 1 / std::sqrt(weights), 0};
}

std::size_t WindowStart(const Readings& zeros) {
  std::size_t start = zeros.size() - kFewest;
  while (start > 0 && zeros.back().time_s - zeros[start - 1].time_s <= kWindow_s) --start;
  return start;
}

// Whether reading `i` and what follows it look like a constant.
bool IsLevelFrom(const Readings& zeros, std::size_t i, double coverage_factor) {
  const int tests = static_cast<int>(zeros.size());
  const auto drift = DriftOf(zeros, i);
  if (!drift || IsSignificant(drift->slope, coverage_factor, tests)) return false;
  if (i + kFewest >= zeros.size()) return true;
  const Estimate later = WeightedMean(zeros, i + 1);
  const Estimate step{zeros[i].error - later.value,
                      std::hypot(zeros[i].sigma, later.standard_uncertainty), 0};
  return !IsSignificant(step, coverage_factor, tests);
}

// Square sum of the weighted residuals of a + b exp(-(t - t0) / tau).
double ApproachChi2(const Readings& zeros, double time_constant_s) {
  Eigen::MatrixXd design(zeros.size(), 2);
  Eigen::VectorXd values(zeros.size());
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    design(row, 0) = 1 / zeros[i].sigma;
    design(row, 1) =
        std::exp(-(zeros[i].time_s - zeros[0].time_s) / time_constant_s) / zeros[i].sigma;
    values(row) = zeros[i].error / zeros[i].sigma;
  }
  const Eigen::VectorXd fit = design.colPivHouseholderQr().solve(values);
  return (values - design * fit).squaredNorm();
}

double ConstantChi2(const Readings& zeros) {
  const double mean = WeightedMean(zeros, 0).value;
  double chi2 = 0;
  for (const ZeroReading& zero : zeros) chi2 += std::pow((zero.error - mean) / zero.sigma, 2);
  return chi2;
}

// Profile of chi2 over time constants from half the shortest gap to three times the whole span.
std::optional<Estimate> TimeConstant(const Readings& zeros) {
  if (zeros.size() < kFewestForApproach) return {};
  const double span_s = zeros.back().time_s - zeros.front().time_s;
  double gap_s = span_s;
  for (std::size_t i = 1; i < zeros.size(); ++i)
    if (zeros[i].time_s > zeros[i - 1].time_s)
      gap_s = std::min(gap_s, zeros[i].time_s - zeros[i - 1].time_s);
  if (!(gap_s > 0)) return {};
  const double first_s = 0.5 * gap_s, ratio = 3 * span_s / first_s;
  std::vector<double> tau_s, chi2;
  for (int i = 0; i < kTimeConstants; ++i) {
    tau_s.push_back(first_s * std::pow(ratio, i / (kTimeConstants - 1.0)));
    chi2.push_back(ApproachChi2(zeros, tau_s.back()));
  }
  const auto best = std::min_element(chi2.begin(), chi2.end());
  const auto line = DriftOf(zeros, 0);
  if (!line || ConstantChi2(zeros) - *best < kSureOfApproach_chi2 ||
      line->chi2 - *best < kSureOfCurvature_chi2)
    return {};
  const auto at = static_cast<std::size_t>(best - chi2.begin());
  std::size_t low = at, high = at;
  while (low > 0 && chi2[low] < *best + 1) --low;
  while (high + 1 < chi2.size() && chi2[high] < *best + 1) ++high;
  if (low == 0 || high + 1 == chi2.size()) return {};
  // Where chi2 passes the limit between two time constants tried.
  const auto crossing_s = [&](std::size_t outer, std::size_t inner) {
    const double share = (*best + 1 - chi2[inner]) / (chi2[outer] - chi2[inner]);
    return tau_s[inner] + share * (tau_s[outer] - tau_s[inner]);
  };
  return Estimate{tau_s[at], 0.5 * (crossing_s(high, high - 1) - crossing_s(low, low + 1)), 0};
}

std::string Sentence(const WarmUp& warm_up, double coverage_factor) {
  const Estimate& drift = *warm_up.drift_per_10_min;
  const std::string numbers = FormatFixed(drift.value, 2) + " microstrain per 10 min (U " +
                              FormatFixed(ExpandedUncertainty(drift, coverage_factor), 2) +
                              ") over the last " + FormatFixed(warm_up.window_s / 60, 1) + " min";
  std::string text = warm_up.still_drifting ? "Still drifting: " + numbers + "."
                                            : "No drift is resolved: " + numbers + ".";
  if (warm_up.settled_since_s)
    text += " Settled since t = " + FormatFixed(*warm_up.settled_since_s, 0) + " s.";
  if (warm_up.time_constant_s)
    text += " Time constant " + FormatFixed(warm_up.time_constant_s->value, 0) + " s (U " +
            FormatFixed(ExpandedUncertainty(*warm_up.time_constant_s, coverage_factor), 0) + ").";
  return text;
}

}  // namespace

WarmUp CheckWarmUp(const Readings& zeros, double coverage_factor) {
  WarmUp warm_up;
  warm_up.count = static_cast<int>(zeros.size());
  const bool certain =
      std::all_of(zeros.begin(), zeros.end(), [](const auto& z) { return z.sigma > 0; });
  std::optional<FittedLine> drift;
  if (zeros.size() >= kFewest && certain) drift = DriftOf(zeros, WindowStart(zeros));
  if (!drift) {
    warm_up.sentence =
        "Whether the instrument was warm cannot be told: " + CountText(zeros.size(), "zero state") +
        " with time_s, at least 3 at different times are needed.";
    return warm_up;
  }
  warm_up.drift_per_10_min = drift->slope;
  warm_up.window_s = zeros.back().time_s - zeros[WindowStart(zeros)].time_s;
  warm_up.still_drifting = IsSignificant(drift->slope, coverage_factor);
  warm_up.time_constant_s = TimeConstant(zeros);
  if (!warm_up.still_drifting) {
    std::size_t level = WindowStart(zeros);
    while (level > 0 && IsLevelFrom(zeros, level - 1, coverage_factor)) --level;
    warm_up.settled_since_s = zeros[level].time_s;
  }
  warm_up.sentence = Sentence(warm_up, coverage_factor);
  return warm_up;
}

}  // namespace telestrain
