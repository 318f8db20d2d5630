#include "report/rounding.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "base/numbers.h"

namespace telestrain {
namespace {

constexpr int kUncertaintyDigits = 2;
constexpr int kMostDecimals = 15;
constexpr int kMostPlaces = 290;  // beyond, scaling by a power of ten would leave a double's range

// The tiny factor keeps log10 of an exact power of ten from falling below its integer.
int DecimalExponent(double value) {
  const double raised = std::abs(value) * (1 + 1e-12);
  return static_cast<int>(
      std::floor(std::log10(std::min(raised, std::numeric_limits<double>::max()))));
}

// Rounds to `decimals` places, which may be negative (tens, hundreds, ...).
double RoundToDecimals(double value, int decimals) {
  if (std::abs(decimals) > kMostPlaces) return value;
  const double scale = std::pow(10.0, std::abs(decimals));
  const double rounded =
      decimals >= 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
  return std::isfinite(rounded) ? rounded : value;
}

// The place of the last of `digits` significant digits. Rounding up may add a digit
// (0.0996 -> 0.100), so it is found from the rounded value.
int DecimalsFor(double value, int digits) {
  const int first = digits - 1 - DecimalExponent(value);
  return digits - 1 - DecimalExponent(RoundToDecimals(value, first));
}

}  // namespace

std::string PrintAtDecimals(double value, int decimals) {
  const double rounded = decimals < 0 ? RoundToDecimals(value, decimals) : value;
  return FormatFixed(rounded, std::clamp(decimals, 0, kMostDecimals));
}

std::optional<int> DecimalsOfColumn(const std::vector<double>& expanded_uncertainties) {
  std::vector<int> decimals;
  for (const double uncertainty : expanded_uncertainties)
    if (std::isfinite(uncertainty) && uncertainty > 0)
      decimals.push_back(DecimalsFor(uncertainty, kUncertaintyDigits));
  if (decimals.empty()) return {};
  const auto median = decimals.begin() + static_cast<std::ptrdiff_t>(decimals.size() / 2);
  std::nth_element(decimals.begin(), median, decimals.end());
  return *median;
}

PrintedResult PrintWithUncertainty(double value, double expanded_uncertainty) {
  TELESTRAIN_CHECK(std::isfinite(expanded_uncertainty) && expanded_uncertainty > 0,
                   "an uncertainty is finite and positive");
  const int decimals = DecimalsFor(expanded_uncertainty, kUncertaintyDigits);
  return {PrintAtDecimals(value, decimals), PrintAtDecimals(expanded_uncertainty, decimals)};
}

std::string PrintUncertainty(double uncertainty) {
  return PrintSignificant(uncertainty, kUncertaintyDigits);
}

std::string PrintSignificant(double value, int digits) {
  if (value == 0) return FormatFixed(0, digits - 1);
  const int exponent = DecimalExponent(value);
  if (exponent >= -4 && exponent < 7) return PrintAtDecimals(value, DecimalsFor(value, digits));
  char buffer[64];
  const auto format = std::chars_format::scientific;
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, digits - 1).ptr;
  return {buffer, end};
}

}  // namespace telestrain
