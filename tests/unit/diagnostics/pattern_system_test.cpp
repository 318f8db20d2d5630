#include "diagnostics/pattern_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "diagnostics/pattern_catalogue.h"
#include "unit/diagnostics/fitted_array.h"

namespace telestrain {
namespace {

using testing_support::FitArray;
using testing_support::FitOptions;
using testing_support::FittedArray;

const KnownPattern& Find(const std::vector<KnownPattern>& patterns, PatternKind kind, int view) {
  for (const KnownPattern& pattern : patterns)
    if (pattern.kind == kind && pattern.view == view) return pattern;
  throw std::logic_error("no such pattern");
}

struct Prepared {
  explicit Prepared(const FittedArray& fitted) : system(fitted.data, fitted.state) {
    system.TakeOut(AdjustedColumns(system, fitted.data, fitted.state));
    patterns = KnownPatterns(system, fitted.data, fitted.state);
  }
  PatternSystem system;
  std::vector<KnownPattern> patterns;
};

FitOptions WithK1() {
  FitOptions options;
  options.synthetic.k1_per_mm2 = 5e-6;
  return options;
}

TEST(PatternSystem, AtTheOptimumNothingAdjustedExplainsAnything) {
  const FittedArray fitted = FitArray({});
  const Prepared made(fitted);
  double squares = 0;
  for (const CornerResidual& r : ResidualsOf(fitted.data, fitted.state))
    squares += r.whitened.squaredNorm();
  // The stage, which the system leaves out, pulls at the poses: 54 equations of 5 um against
  // corners of 0.1 px, whose mean is known to 0.04 um, take (0.04 / 5)^2 54 = 0.003 of it.
  EXPECT_NEAR(made.system.Squares(), squares, 0.02);
}

TEST(PatternSystem, ExplainsWhatFreeingTheParameterGains) {
  const FittedArray fitted = FitArray(WithK1());
  const Prepared made(fitted);
  const PatternFit fit = made.system.Fit(Find(made.patterns, PatternKind::kRadialK1, -1).columns);
  BundleOptions freed;
  freed.model.distortion[0] = true;
  const BundleResult richer = AdjustBundle(fitted.data, fitted.state, freed).value();
  const BundleResult poorer = AdjustBundle(fitted.data, fitted.state, {}).value();
  EXPECT_EQ(fit.rank, 1);
  // Second order: the pattern is some 0.02 px of a field of 1000 px.
  EXPECT_NEAR(fit.explained / (poorer.chi2 - richer.chi2), 1, 1e-3);
  EXPECT_NEAR(fit.values[0] / richer.state.array.lenses.front().distortion[0], 1, 1e-3);
}

TEST(PatternSystem, WhatWasAdjustedOrTakenOutIsInvisible) {
  FitOptions options = WithK1();
  options.bundle.model.distortion[0] = true;
  const FittedArray fitted = FitArray(options);
  Prepared made(fitted);
  EXPECT_EQ(made.system.Fit(Find(made.patterns, PatternKind::kRadialK1, -1).columns).rank, 0);
  const KnownPattern& drift = Find(made.patterns, PatternKind::kViewDrift, 1);
  const int degrees = made.system.Degrees();
  EXPECT_EQ(made.system.Fit(drift.columns).rank, 2);
  made.system.TakeOut(drift.columns);
  EXPECT_EQ(made.system.Fit(drift.columns).rank, 0);
  EXPECT_EQ(made.system.Degrees(), degrees - 2);
}

TEST(PatternSystem, TheBoardsOfAnImageHaveTheirPoseLess) {
  const FittedArray fitted = FitArray({});
  const Prepared made(fitted);
  EXPECT_EQ(made.system.FitBoards({0}).rank, 6);
  EXPECT_EQ(made.system.FitBoards({0, 1, 2, 3}).rank, 4 * 6 - 6);
}

TEST(PatternSystem, PValuesOfNoiseAreUniform) {
  // Every pattern of a few calibrations; their mean is 1/2 with a standard deviation of 1 /
  // sqrt(12) over the root of the number that is independent, at least the 4 views of each of 8.
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 50; seed < 58; ++seed) {
    FitOptions options;
    options.synthetic.seed = seed;
    options.synthetic.poses = 6;
    const FittedArray fitted = FitArray(options);
    const Prepared made(fitted);
    for (std::size_t b = 0; b < fitted.data.boards.size(); ++b, ++count)
      sum += made.system.FitBoards({b}).p_value;
  }
  EXPECT_NEAR(sum / count, 0.5, 4 / std::sqrt(12.0 * 32));
}

}  // namespace
}  // namespace telestrain
