#pragma once

#include <optional>
#include <string>
#include <vector>

namespace telestrain {

// The one place where a measured number becomes text.

struct PrintedResult {
  std::string value;
  std::string uncertainty;
};

// JCGM 100 (GUM) 7.2.6: the expanded uncertainty with two significant digits, the value rounded to
// the same decimal place. 12.34567 with U 0.0123 gives "12.346" and "0.012"; 4567 with U 123 gives
// "4570" and "120". `expanded_uncertainty` is finite and > 0 (a broken contract otherwise).
PrintedResult PrintWithUncertainty(double value, double expanded_uncertainty);

// The decimal place of a whole column: the median of the places that its expanded uncertainties ask
// for by themselves; those that are not > 0 are left out. Nothing when none is left.
std::optional<int> DecimalsOfColumn(const std::vector<double>& expanded_uncertainties);
// At this place; negative ones are tens, hundreds, …
std::string PrintAtDecimals(double value, int decimals);

// An uncertainty that stands alone: two significant digits. 0.0996 gives "0.10".
std::string PrintUncertainty(double uncertainty);

// `digits` significant digits, in exponent form below 0.0001 and from 1e7 on: "0.1235",
// "-1.20e-06".
std::string PrintSignificant(double value, int digits);

}  // namespace telestrain
