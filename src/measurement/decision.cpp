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

// `room`: how far the value stays below its limit.
const char* DoubtPattern(double room) {
  if (room == 0) return "in doubt: exactly on the limit; no smaller U decides it";
  if (room > 0)
    return "in doubt: {{margin}} inside the limit, less than U; a repeat with U of {{needed}} or "
           "less passes";
  return "in doubt: {{margin}} outside the limit, less than U; a repeat with U below {{needed}} "
         "fails";
}

std::string Filled(std::string pattern, const std::map<std::string, std::string>& values) {
  for (const auto& [name, value] : values) {
    const std::string place = "{{" + name + "}}";
    const std::size_t at = pattern.find(place);
    if (at != std::string::npos) pattern.replace(at, place.size(), value);
  }
  return pattern;
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
      decision.pattern = "not decided: value, uncertainty or limit is missing";
      break;
    case Verdict::kPass:
      decision.margin = room - u;
      decision.pattern = "passes with {{margin}} to spare";
      decision.values["margin"] = text(decision.margin);
      break;
    case Verdict::kFail:
      decision.margin = room + u;
      decision.pattern = "fails: {{margin}} outside";
      decision.values["margin"] = text(-decision.margin);
      break;
    case Verdict::kDoubt:
      decision.margin = room - u;
      decision.pattern = DoubtPattern(room);
      if (room != 0) decision.values["margin"] = decision.values["needed"] = text(std::abs(room));
      break;
  }
  if (u > 0 && (decision.verdict == Verdict::kPass || decision.verdict == Verdict::kFail))
    decision.pattern += " beyond U";
  decision.words = Filled(decision.pattern, decision.values);
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
