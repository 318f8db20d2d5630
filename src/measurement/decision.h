#pragma once

#include <string>
#include <vector>

#include "session/session.h"

namespace telestrain {

// What a limit says about a measured value. A value in doubt lies so near to its limit that the
// uncertainty does not let anyone prove that it conforms or that it does not.
enum class Verdict { kPass, kDoubt, kFail, kUndecided };

// Compares |value| with `limit` (>= 0); all three in one unit.
// kGuarded (ISO 14253-1): pass if |value| + U <= limit, fail if |value| - U > limit, doubt between.
// kSimple (shared risk): pass if |value| <= limit, else fail; U is not used.
// A value or limit that is not finite, a negative limit and, with kGuarded, an uncertainty that is
// not finite or negative, are kUndecided.
Verdict Decide(double value, double expanded_uncertainty, double limit, DecisionRule rule);

// How strongly a verdict speaks against acceptance: fail 3, doubt 2, undecided 1, pass 0. An
// undecided entry outranks a passed one, so that the worst of a list shows what is not known.
int Severity(Verdict verdict);

// The worst counts: fail if any fails, doubt if any is in doubt, pass if at least one was decided,
// undecided otherwise. Undecided entries do not weigh.
Verdict OverallVerdict(const std::vector<Verdict>& verdicts);

// "pass", "doubt", "fail" or "undecided", as in results.json.
std::string VerdictName(Verdict verdict);

}  // namespace telestrain
