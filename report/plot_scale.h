#pragma once

#include <string>
#include <vector>

namespace telestrain {

// One axis: its range is widened to whole steps; ticks stand at round numbers.
struct PlotAxis {
  std::string label;
  double low = 0, high = 1;  // any order is corrected, an empty range is widened
  bool whole_numbers = false;
  bool widen = true;         // to whole steps
  bool logarithmic = false;  // both ends must be positive (a broken contract otherwise)
  double spacing_pt = 0;     // of labelled ticks along x; 0: the plot's own
};

// Where the values of an axis stand along its length, and its ticks.
class PlotScale {
 public:
  PlotScale() = default;
  // Labelled ticks stand about `spacing_pt` apart or more on an axis of `length_pt`.
  PlotScale(const PlotAxis& axis, double length_pt, double spacing_pt);

  struct Tick {
    double value = 0;
    std::string label;  // empty: a minor tick
  };
  std::vector<Tick> Ticks() const;

  double low() const { return low_; }
  double high() const { return high_; }
  bool logarithmic() const { return logarithmic_; }
  // 0 at the low end, 1 at the high one.
  double Share(double value) const;

 private:
  void ChooseLinear(const PlotAxis& axis, double most_ticks);
  void ChooseLogarithmic(bool widen, double most_ticks);
  std::vector<Tick> DecadeTicks() const;

  double low_ = 0, high_ = 1, step_ = 1;
  int decimals_ = 0;
  bool logarithmic_ = false;
  int decade_step_ = 1;                     // of labelled powers of ten
  std::vector<int> labelled_digits_ = {1};  // of a decade
};

}  // namespace telestrain
