#pragma once

#include <optional>
#include <string>

namespace telestrain {

// Printed numbers and units in the form of the D-SI (SI_Format.xsd 2.2.1).

// A printed unit. The D-SI has no pixel: it counts as one, and `non_si` is the unit as printed.
struct DsiUnit {
  std::string unit;      // "\micro\metre", "\milli\metre\tothe{-1}", "\one"
  int power_of_ten = 0;  // of the number, where the D-SI has no such prefix: -9 of "10⁻⁹ px"
  std::string non_si;    // "px/mm" or empty
};

// The unit of a printed text such as "px/mm", "µε", "ppm/mm²", "10⁻⁹ rad" or "". Nothing for a
// unit that is not known here, so that no number gets a wrong one.
std::optional<DsiUnit> DsiUnitOf(const std::string& printed);

// The printed number with the same digits: DsiNumber("-31.27", -6) is "-31.27E-6". Nothing when the
// text is not one decimal number.
std::optional<std::string> DsiNumber(const std::string& printed, int power_of_ten);

// The probability that a normal value lies within `coverage_factor` standard deviations, with four
// decimals and at most 0.9999, so that it is never 1.
std::string CoverageProbability(double coverage_factor);

}  // namespace telestrain
