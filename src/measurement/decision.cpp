#include "measurement/decision.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"

namespace telestrain {
namespace {

// Two significant digits; `size` > 0 sets the decimals where the value itself is small.
std::string TwoDigits(double value, double size) {
  const double largest = std::max(std::abs(value), size);
  if (!(largest > 0)) return "0";
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(largest)));
  return FormatFixed(value, std::clamp(decimals, 0, 9));
}

}  // namespace

int Severity(Verdict verdict) {
  switch (verdict) {
    case Verdict::kFail:
      return 3;
    case Verdict::kDoubt:
      return 2;
    case Verdict::kUndecided:
      return 1;
    case Verdict::kPass:
      return 0;
  }
  return 0;
}

Verdict Decide(double value, double expanded_uncertainty, double limit, DecisionRule rule) {
  if (!std::isfinite(value) || !std::isfinite(limit) || limit < 0) return Verdict::kUndecided;
  const double size = std::abs(value);
  if (rule == DecisionRule::kSimple) return size <= limit ? Verdict::kPass : Verdict::kFail;
  if (!std::isfinite(expanded_uncertainty) || expanded_uncertainty < 0) return Verdict::kUndecided;
  if (size + expanded_uncertainty <= limit) return Verdict::kPass;
  return size - expanded_uncertainty > limit ? Verdict::kFail : Verdict::kDoubt;
}

Decision DecideInWords(double value, double expanded_uncertainty, double limit, DecisionRule rule,
                       const std::string& unit) {
  Decision decision;
  decision.verdict = Decide(value, expanded_uncertainty, limit, rule);
  const bool guarded = rule == DecisionRule::kGuarded;
  const double u = guarded ? expanded_uncertainty : 0;
  const double room = limit - std::abs(value);
  const auto text = [&](double number) {
    return TwoDigits(number, std::min(u, limit)) + " " + unit;
  };
  switch (decision.verdict) {
    case Verdict::kUndecided:
      decision.words = "not decided: value, uncertainty or limit is missing";
      break;
    case Verdict::kPass:
      decision.margin = room - u;
      decision.words = "passes with " + text(decision.margin) + " to spare";
      break;
    case Verdict::kFail:
      decision.margin = room + u;
      decision.words = "fails: " + text(-decision.margin) + " outside";
      break;
    case Verdict::kDoubt:
      decision.margin = room - u;
      decision.words = "in doubt: " + text(-decision.margin) + " over the guard band; ";
      decision.words += room == 0 ? "on the limit, no uncertainty decides it"
                                  : "repeat with U of " + text(std::abs(room)) +
                                        (room > 0 ? " or less to pass" : " or less to fail");
      break;
  }
  if (u > 0 && (decision.verdict == Verdict::kPass || decision.verdict == Verdict::kFail))
    decision.words += " beyond U";
  return decision;
}

Verdict OverallVerdict(const std::vector<Verdict>& verdicts) {
  Verdict worst = Verdict::kUndecided;
  for (const Verdict verdict : verdicts) {
    if (verdict == Verdict::kUndecided) continue;
    if (worst == Verdict::kUndecided || Severity(verdict) > Severity(worst)) worst = verdict;
  }
  return worst;
}

std::string VerdictName(Verdict verdict) {
  static constexpr const char* kNames[] = {"pass", "doubt", "fail", "undecided"};
  return kNames[static_cast<int>(verdict)];
}

}  // namespace telestrain
