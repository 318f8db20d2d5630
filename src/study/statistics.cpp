#include "study/statistics.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace telestrain {

ErrorFigures FiguresOf(const std::vector<double>& errors) {
  ErrorFigures figures;
  figures.count = static_cast<int>(errors.size());
  if (errors.empty()) return figures;
  const double count = static_cast<double>(errors.size());
  double squares = 0;
  for (const double error : errors) {
    figures.mean += error / count;
    squares += error * error;
    figures.max_abs = std::max(figures.max_abs, std::abs(error));
  }
  figures.rms = std::sqrt(squares / count);
  double about_mean = 0;
  for (const double error : errors) about_mean += std::pow(error - figures.mean, 2);
  if (errors.size() > 1) figures.sd = std::sqrt(about_mean / (count - 1));
  return figures;
}

namespace {

// Index of the bin of `value` among `bins` equal ones from `low` to `high`.
std::size_t BinOf(double value, double low, double high, int bins) {
  const double place = std::floor((value - low) / (high - low) * bins);
  return static_cast<std::size_t>(std::clamp(place, 0.0, bins - 1.0));
}

double CenterOf(std::size_t bin, double low, double high, int bins) {
  return low + (static_cast<double>(bin) + 0.5) * (high - low) / bins;
}

}  // namespace

Histogram HistogramOf(const std::vector<double>& values, double low, double high, int bins) {
  TELESTRAIN_CHECK(bins > 0 && high > low, "a histogram without bins");
  Histogram histogram;
  histogram.percent.assign(static_cast<std::size_t>(bins), 0.0);
  for (std::size_t bin = 0; bin < histogram.percent.size(); ++bin)
    histogram.centers.push_back(CenterOf(bin, low, high, bins));
  for (const double value : values)
    histogram.percent[BinOf(value, low, high, bins)] += 100.0 / static_cast<double>(values.size());
  return histogram;
}

Profile ProfileOf(const std::vector<double>& positions, const std::vector<double>& errors,
                  int bins) {
  TELESTRAIN_CHECK(bins > 0 && positions.size() == errors.size(), "a profile of unequal lists");
  const auto count = static_cast<std::size_t>(bins);
  std::vector<double> sums(count), squares(count);
  std::vector<int> counts(count);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::size_t bin = BinOf(positions[i], -1, 1, bins);
    sums[bin] += errors[i];
    squares[bin] += errors[i] * errors[i];
    ++counts[bin];
  }
  Profile profile;
  for (std::size_t bin = 0; bin < count; ++bin) {
    if (counts[bin] == 0) continue;
    profile.position.push_back(CenterOf(bin, -1, 1, bins));
    profile.rms.push_back(std::sqrt(squares[bin] / counts[bin]));
    profile.mean.push_back(sums[bin] / counts[bin]);
    profile.count.push_back(counts[bin]);
  }
  return profile;
}

}  // namespace telestrain
