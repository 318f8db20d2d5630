#pragma once

#include <vector>

namespace telestrain {

// Tail probabilities of the distributions that tests of residuals need, for any degrees of freedom
// (thousands included). Right to about 1e-10 relative where they are above 1e-300, 0 below.
// Series and continued fractions of the incomplete gamma and beta functions (Abramowitz and
// Stegun 6.5, 26.5).

double NormalUpperTail(double z);                                   // P(Z > z)
double ChiSquareUpperTail(double x, double degrees);                // P(X > x)
double FUpperTail(double f, double numerator, double denominator);  // by degrees of freedom
double StudentTwoSided(double t, double degrees);                   // P(|T| > |t|)

// Holm's adjusted p-values (Scand. J. Statist. 6, 1979), in the order given: rejecting every test
// whose adjusted value is below a keeps the chance of any false rejection below a, however the
// tests depend on each other.
std::vector<double> HolmAdjusted(const std::vector<double>& p_values);

}  // namespace telestrain
