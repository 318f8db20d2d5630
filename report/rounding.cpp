#include "report/rounding.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/check.h"
#include "base/numbers.h"

namespace telestrain {
namespace {

constexpr int kUncertaintyDigits = 2;
constexpr int kMostDecimals = 15;

int DecimalExponent(double value) {
  return static_cast<int>(std::floor(std::log10(std::abs(value))));
}

// Rounds to `decimals` places, which may be negative (tens, hundreds, ...).
double RoundToDecimals(double value, int decimals) {
  const double scale = std::pow(10.0, std::abs(decimals));
  return decimals >= 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
}

// Rounding up may add a digit (0.0996 -> 0.100), so the place is found from the rounded value. The
// tiny factor keeps log10 of an exact power of ten from falling below its integer.
int DecimalsForUncertainty(double uncertainty) {
  const int first = kUncertaintyDigits - 1 - DecimalExponent(uncertainty);
  return kUncertaintyDigits - 1 -
         DecimalExponent(RoundToDecimals(uncertainty, first) * (1 + 1e-12));
}

std::string PrintRounded(double value, int decimals) {
  const double rounded = decimals < 0 ? RoundToDecimals(value, decimals) : value;
  return FormatFixed(rounded, std::clamp(decimals, 0, kMostDecimals));
}

}  // namespace

PrintedResult PrintWithUncertainty(double value, double expanded_uncertainty) {
  TELESTRAIN_CHECK(std::isfinite(expanded_uncertainty) && expanded_uncertainty > 0,
                   "an uncertainty is finite and positive");
  const int decimals = DecimalsForUncertainty(expanded_uncertainty);
  return {PrintRounded(value, decimals), PrintRounded(expanded_uncertainty, decimals)};
}

std::string PrintSignificant(double value, int digits) {
  if (value == 0) return FormatFixed(0, digits - 1);
  const int exponent = DecimalExponent(value);
  if (exponent >= -4 && exponent < 7) return PrintRounded(value, digits - 1 - exponent);
  char buffer[64];
  const auto format = std::chars_format::scientific;
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, digits - 1).ptr;
  return {buffer, end};
}

}  // namespace telestrain
