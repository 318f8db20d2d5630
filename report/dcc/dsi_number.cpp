#include "report/dcc/dsi_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/numbers.h"

namespace telestrain {
namespace {

struct Known {
  std::string_view printed;
  std::string_view dsi;
  int power_of_ten = 0;
};

constexpr std::string_view kPixel = "px";
constexpr int kLargestPower = 400;  // of ten; no double has more

// D-SI guide 1.3, appendix A. "\one" takes neither prefix nor exponent, hence the powers of ten.
constexpr std::array kUnits = {Known{"mm", "\\milli\\metre"},
                               Known{"µm", "\\micro\\metre"},
                               Known{"nm", "\\nano\\metre"},
                               Known{"m", "\\metre"},
                               Known{"°", "\\degree"},
                               Known{"rad", "\\radian"},
                               Known{"°C", "\\degreecelsius"},
                               Known{"K", "\\kelvin"},
                               Known{"s", "\\second"},
                               Known{"min", "\\minute"},
                               Known{"h", "\\hour"},
                               Known{kPixel, ""},
                               Known{"1", ""},
                               Known{"", ""},
                               Known{"ppm", "", -6},
                               Known{"µε", "\\micro\\metre\\metre\\tothe{-1}"}};

constexpr std::array<std::string_view, 10> kSuperscripts = {"⁰", "¹", "²", "³", "⁴",
                                                            "⁵", "⁶", "⁷", "⁸", "⁹"};

// Takes the exponent off the end of `token`; 1 when there is none.
int TakeExponent(std::string_view& token) {
  for (std::size_t digit = 2; digit < kSuperscripts.size(); ++digit)
    if (token.ends_with(kSuperscripts[digit])) {
      token.remove_suffix(kSuperscripts[digit].size());
      return static_cast<int>(digit);
    }
  return 1;
}

// Multiplies `unit` by one factor of the text, to the power of `sign`.
bool AddFactor(std::string_view token, int sign, DsiUnit& unit) {
  const int exponent = sign * TakeExponent(token);
  for (const Known& known : kUnits) {
    if (known.printed != token) continue;
    const bool compound = known.dsi.ends_with('}');
    if (compound && exponent != 1) return false;
    unit.power_of_ten += exponent * known.power_of_ten;
    if (known.dsi.empty()) return true;
    unit.unit += known.dsi;
    if (exponent != 1) unit.unit += "\\tothe{" + std::to_string(exponent) + "}";
    return true;
  }
  return false;
}

// "10⁻⁹" or "10⁻⁹ " in front.
int TakePower(std::string_view& text) {
  constexpr std::string_view kStart = "10⁻";
  if (!text.starts_with(kStart)) return 0;
  for (std::size_t digit = 1; digit < kSuperscripts.size(); ++digit) {
    const std::string power = std::string(kStart) + std::string(kSuperscripts[digit]);
    if (!text.starts_with(power)) continue;
    text.remove_prefix(power.size());
    if (text.starts_with(' ')) text.remove_prefix(1);
    return -static_cast<int>(digit);
  }
  return 0;
}

}  // namespace

std::optional<DsiUnit> DsiUnitOf(const std::string& printed) {
  DsiUnit unit;
  std::string_view rest = printed;
  unit.power_of_ten = TakePower(rest);
  for (int sign = 1;; sign = -1) {
    const std::size_t end = rest.find('/');
    const std::string_view factor = rest.substr(0, end);
    const bool only = sign == 1 && end == std::string_view::npos;
    if ((factor.empty() && !only) || !AddFactor(factor, sign, unit)) return std::nullopt;
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  if (unit.unit.empty()) unit.unit = "\\one";
  if (printed.find(kPixel) != std::string::npos) unit.non_si = printed;
  return unit;
}

std::optional<std::string> DsiNumber(const std::string& printed, int power_of_ten) {
  if (!ParseDouble(printed)) return std::nullopt;
  const std::size_t mark = printed.find_first_of("eE");
  if (mark != std::string::npos) {
    std::string exponent = printed.substr(mark + 1);
    if (exponent.starts_with('+')) exponent.erase(0, 1);
    const auto power = ParseInt(exponent);
    if (!power || std::abs(*power) > kLargestPower) return std::nullopt;
    power_of_ten += *power;
  }
  const std::string digits = printed.substr(0, mark);
  return power_of_ten == 0 ? digits : digits + "E" + std::to_string(power_of_ten);
}

std::string CoverageProbability(double coverage_factor) {
  const double probability = std::erf(coverage_factor / std::sqrt(2.0));
  return FormatFixed(std::min(probability, 0.9999), 4);
}

}  // namespace telestrain
