#pragma once

#include <vector>

namespace telestrain {

// Figures of a list of errors, in its own unit. All zero for an empty list.
struct ErrorFigures {
  int count = 0;
  double mean = 0;
  double sd = 0;  // about the mean, count - 1
  double rms = 0;
  double max_abs = 0;
};
ErrorFigures FiguresOf(const std::vector<double>& errors);

// A histogram of `bins` equal bins from `low` to `high`: centres of the bins and the share of the
// values per bin in percent. Values outside fall into the outermost bins.
struct Histogram {
  std::vector<double> centers, percent;
};
Histogram HistogramOf(const std::vector<double>& values, double low, double high, int bins);

// Root mean square of the errors in `bins` equal bins of their position in [-1, 1].
struct Profile {
  std::vector<double> position, rms, mean;
  std::vector<int> count;
};
Profile ProfileOf(const std::vector<double>& positions, const std::vector<double>& errors,
                  int bins);

}  // namespace telestrain
