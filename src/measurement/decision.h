#pragma once

#include <map>
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

// A verdict with its reason, for a reader.
struct Decision {
  Verdict verdict = Verdict::kUndecided;
  // Room between the value with its guard band and the limit; negative where it is exceeded. 0 when
  // undecided.
  double margin = 0;
  // "passes with 3.2 µm to spare beyond U", "in doubt: 1.4 µm inside the limit, less than U; a
  // repeat with U of 1.4 µm or less passes", "fails: 1.2 µm outside beyond U", "not decided: …".
  std::string words;
  // The same sentence for a translator: its {{margin}} and {{needed}} stand in `values`.
  std::string pattern;
  std::map<std::string, std::string> values;
};

// Decide() and what it means; `unit` is only printed. Figures have two significant digits of the
// margin, or of U where that is larger.
Decision DecideInWords(double value, double expanded_uncertainty, double limit, DecisionRule rule,
                       const std::string& unit);

// How strongly a verdict speaks against acceptance: fail 3, doubt 2, undecided 1, pass 0. An
// undecided entry outranks a passed one, so that the worst of a list shows what is not known.
int Severity(Verdict verdict);

// The worst counts: fail if any fails, doubt if any is in doubt, pass if at least one was decided,
// undecided otherwise. Undecided entries do not weigh.
Verdict OverallVerdict(const std::vector<Verdict>& verdicts);

// "pass", "doubt", "fail" or "undecided", as in results.json.
std::string VerdictName(Verdict verdict);

}  // namespace telestrain
