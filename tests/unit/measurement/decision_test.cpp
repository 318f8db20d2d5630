#include "measurement/decision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace telestrain {
namespace {

struct Case {
  double value, expanded_uncertainty, limit;
  Verdict guarded, simple;
};

TEST(Decision, FollowsTheTableOfIso14253) {
  const Case cases[] = {
      {0.0, 0.0, 10.0, Verdict::kPass, Verdict::kPass},
      {8.0, 2.0, 10.0, Verdict::kPass, Verdict::kPass},     // |value| + U on the limit
      {-8.0, 2.0, 10.0, Verdict::kPass, Verdict::kPass},    // the sign does not count
      {8.5, 2.0, 10.0, Verdict::kDoubt, Verdict::kPass},    // U reaches over the limit
      {-11.0, 2.0, 10.0, Verdict::kDoubt, Verdict::kFail},  // outside, but not proved
      {12.0, 2.0, 10.0, Verdict::kDoubt, Verdict::kFail},   // |value| - U on the limit
      {12.5, 2.0, 10.0, Verdict::kFail, Verdict::kFail},
      {-13.0, 2.0, 10.0, Verdict::kFail, Verdict::kFail},
      {10.0, 0.0, 10.0, Verdict::kPass, Verdict::kPass},  // without uncertainty there is no doubt
      {10.5, 0.0, 10.0, Verdict::kFail, Verdict::kFail},
      {0.0, 20.0, 10.0, Verdict::kDoubt, Verdict::kPass},  // U alone exceeds the limit
  };
  for (const Case& c : cases) {
    EXPECT_EQ(Decide(c.value, c.expanded_uncertainty, c.limit, DecisionRule::kGuarded), c.guarded)
        << c.value << " with U " << c.expanded_uncertainty;
    EXPECT_EQ(Decide(c.value, c.expanded_uncertainty, c.limit, DecisionRule::kSimple), c.simple)
        << c.value << " with U " << c.expanded_uncertainty;
  }
}

TEST(Decision, NeverPassesWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const DecisionRule rule : {DecisionRule::kGuarded, DecisionRule::kSimple}) {
    EXPECT_EQ(Decide(nan, 0, 1, rule), Verdict::kUndecided);
    EXPECT_EQ(Decide(0, 0, nan, rule), Verdict::kUndecided);
    EXPECT_EQ(Decide(infinity, 0, 1, rule), Verdict::kUndecided);
    EXPECT_EQ(Decide(0, 0, -1, rule), Verdict::kUndecided);
  }
  EXPECT_EQ(Decide(0, nan, 1, DecisionRule::kGuarded), Verdict::kUndecided);
  EXPECT_EQ(Decide(0, -1, 1, DecisionRule::kGuarded), Verdict::kUndecided);
}

TEST(Decision, OverallVerdictIsTheWorstDecidedOne) {
  using enum Verdict;
  EXPECT_EQ(OverallVerdict({}), kUndecided);
  EXPECT_EQ(OverallVerdict({kUndecided}), kUndecided);
  EXPECT_EQ(OverallVerdict({kPass, kUndecided}), kPass);
  EXPECT_EQ(OverallVerdict({kPass, kDoubt, kPass}), kDoubt);
  EXPECT_EQ(OverallVerdict({kDoubt, kFail, kPass}), kFail);
}

TEST(Decision, NamesMatchTheResultsFile) {
  EXPECT_EQ(VerdictName(Verdict::kPass), "pass");
  EXPECT_EQ(VerdictName(Verdict::kDoubt), "doubt");
  EXPECT_EQ(VerdictName(Verdict::kFail), "fail");
  EXPECT_EQ(VerdictName(Verdict::kUndecided), "undecided");
}

}  // namespace
}  // namespace telestrain
