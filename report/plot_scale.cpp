#include "report/plot_scale.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numbers.h"

namespace telestrain {
namespace {

// The smallest of 1, 2, 5 times a power of ten that is not below `step`.
double RoundStep(double step) {
  const double power = std::pow(10, std::floor(std::log10(step)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= step * (1 - 1e-9)) return digit * power;
  return 10 * power;
}

// The largest of 1, 2, 5 times a power of ten that is not above `value`.
double RoundDown(double value) {
  const double power = std::pow(10, std::floor(std::log10(value) + 1e-9));
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power <= value * (1 + 1e-9)) return digit * power;
  return power;
}

// Values of a damaged file may be any; sums and ratios of these stay doubles.
double Bounded(double value, bool logarithmic) {
  constexpr double kLargest = 1e100;
  if (std::isnan(value)) return logarithmic ? 1 : 0;
  if (logarithmic && value > 0) return std::clamp(value, 1 / kLargest, kLargest);
  return std::clamp(value, -kLargest, kLargest);
}

std::string Superscript(int number) {
  static const char* const kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += kDigits[digit - '0'];
  return text;
}

// "0.02", "500"; as powers "2·10⁻⁶".
std::string DecadeLabel(int digit, int exponent, bool as_power) {
  if (!as_power) return FormatFixed(digit * std::pow(10, exponent), std::max(0, -exponent));
  return (digit == 1 ? "" : std::to_string(digit) + "·") + "10" + Superscript(exponent);
}

}  // namespace

PlotScale::PlotScale(const PlotAxis& axis, double length_pt, double spacing_pt)
    : low_(Bounded(std::min(axis.low, axis.high), axis.logarithmic)),
      high_(Bounded(std::max(axis.low, axis.high), axis.logarithmic)),
      logarithmic_(axis.logarithmic) {
  const double most_ticks = std::floor(length_pt / spacing_pt);
  if (logarithmic_)
    ChooseLogarithmic(axis.widen, most_ticks);
  else
    ChooseLinear(axis, std::clamp(most_ticks, 2.0, 10.0));
}

void PlotScale::ChooseLinear(const PlotAxis& axis, double most_ticks) {
  if (!(high_ - low_ > 1e-12 * std::max(1.0, std::abs(high_)))) {
    const double half = std::max(1.0, 1e-9 * std::abs(high_));  // 1 is nothing beside 1e17
    low_ -= half;
    high_ += half;
  }
  step_ = RoundStep((high_ - low_) / most_ticks);
  if (axis.whole_numbers) step_ = std::max(1.0, step_);
  if (axis.widen) {
    low_ = step_ * std::floor(low_ / step_ + 1e-9);
    high_ = step_ * std::ceil(high_ / step_ - 1e-9);
  }
  decimals_ = std::max(0, static_cast<int>(-std::floor(std::log10(step_) + 1e-9)));
}

void PlotScale::ChooseLogarithmic(bool widen, double most_ticks) {
  TELESTRAIN_CHECK(low_ > 0, "a logarithmic axis shows positive values only");
  if (!(high_ > low_ * (1 + 1e-9))) {
    low_ /= 2;
    high_ *= 2;
  }
  if (widen) {
    low_ = RoundDown(low_);
    high_ = RoundStep(high_);
  }
  const double decades = std::log10(high_ / low_);
  if (decades < 1)
    labelled_digits_ = {1, 2, 3, 4, 5, 6, 8};
  else if (3 * decades <= most_ticks)
    labelled_digits_ = {1, 2, 5};
  decade_step_ = std::max(1, static_cast<int>(std::ceil(decades / std::max(1.0, most_ticks))));
}

std::vector<PlotScale::Tick> PlotScale::DecadeTicks() const {
  const auto is_labelled = [&](int digit) {
    return std::find(labelled_digits_.begin(), labelled_digits_.end(), digit) !=
           labelled_digits_.end();
  };
  constexpr int kMostPlainZeros = 4;
  std::vector<Tick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low_) + 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(high_) + 1e-9));
  const bool as_powers = first < -kMostPlainZeros || last > kMostPlainZeros + 1;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10, exponent);
      if (value < low_ * (1 - 1e-9) || value > high_ * (1 + 1e-9)) continue;
      const bool labelled = is_labelled(digit) && exponent % decade_step_ == 0;
      if (!labelled && digit > 1 && decade_step_ > 1) continue;  // too dense
      ticks.push_back({value, labelled ? DecadeLabel(digit, exponent, as_powers) : ""});
    }
  }
  return ticks;
}

std::vector<PlotScale::Tick> PlotScale::Ticks() const {
  if (logarithmic_) return DecadeTicks();
  std::vector<Tick> ticks;
  const auto first = static_cast<long>(std::ceil(low_ / step_ - 1e-6));
  const auto last = static_cast<long>(std::floor(high_ / step_ + 1e-6));
  for (long i = first; i <= last; ++i) {
    const double value = static_cast<double>(i) * step_;
    ticks.push_back({value, FormatFixed(value, decimals_)});
  }
  return ticks;
}

double PlotScale::Share(double value) const {
  if (!logarithmic_) return (value - low_) / (high_ - low_);
  return std::log(value / low_) / std::log(high_ / low_);
}

}  // namespace telestrain
