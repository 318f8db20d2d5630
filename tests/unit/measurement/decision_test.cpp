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

TEST(Decision, SaysTheMarginInWords) {
  struct Worded {
    double value, expanded_uncertainty, limit;
    DecisionRule rule;
    double margin;
    const char* words;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using enum DecisionRule;
  for (const Worded& c :
       {Worded{-5, 1.8, 10, kGuarded, 3.2, "passes with 3.2 µm to spare beyond U"},
        Worded{8.6, 1.8, 10, kGuarded, -0.4,
               "in doubt: 1.4 µm inside the limit, less than U; a repeat with U of 1.4 µm or less "
               "passes"},
        Worded{
            10.5, 1.8, 10, kGuarded, -2.3,
            "in doubt: 0.5 µm outside the limit, less than U; a repeat with U below 0.5 µm fails"},
        Worded{-13, 1.8, 10, kGuarded, -1.2, "fails: 1.2 µm outside beyond U"},
        Worded{9, 5, 10, kSimple, 1, "passes with 1.0 µm to spare"},
        Worded{12, 5, 10, kSimple, -2, "fails: 2.0 µm outside"},
        Worded{0.0421, 0, 0.1, kGuarded, 0.0579, "passes with 0.058 µm to spare"},
        Worded{5, nan, 10, kGuarded, 0, "not decided: value, uncertainty or limit is missing"}}) {
    const Decision decision = DecideInWords(c.value, c.expanded_uncertainty, c.limit, c.rule, "µm");
    EXPECT_EQ(decision.words, c.words);
    EXPECT_NEAR(decision.margin, c.margin, 1e-12) << c.words;  // rounding
    EXPECT_EQ(decision.verdict, Decide(c.value, c.expanded_uncertainty, c.limit, c.rule));
  }
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
