#pragma once

namespace telestrain {

// A result with its standard uncertainty, both in the unit that its name says.
struct Estimate {
  double value = 0;
  double standard_uncertainty = 0;
  // Of the scatter that the uncertainty was found from; 0: it follows from known uncertainties.
  int degrees_of_freedom = 0;
};

// The factor t with P(|T| > t) = P(|Z| > coverage_factor) / tests: T after Student with `degrees`
// of freedom (0: normal), Z normal. k = 2 and one test give 2 for 0 degrees, 2.87 for 4 (JCGM 100,
// G.3.2). With `tests` > 1 the chance that any of so many true zeros looks significant stays what
// it is for one (Bonferroni). coverage_factor within 0 and 10; 0 where it is 0.
double StudentFactor(double coverage_factor, int degrees, int tests = 1);

// The standard uncertainty times that factor.
double ExpandedUncertainty(const Estimate& estimate, double coverage_factor);

// Whether the value differs from zero by more than its uncertainty explains.
bool IsSignificant(const Estimate& estimate, double coverage_factor, int tests = 1);

}  // namespace telestrain
