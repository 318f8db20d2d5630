#include "measurement/decision.h"

#include <cmath>

namespace telestrain {

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
