#pragma once

#include <string>
#include <vector>

#include "calibration/bundle_adjustment.h"

namespace telestrain {

// One step of the model choice: is the fit better with these parameters than chance explains?
struct ModelTest {
  std::string added;  // "k1", "p1 p2", …; "k1, asked again" when it was taken back at the end
  std::string model;  // what was estimated in this fit
  int added_parameters = 0;
  double chi2 = 0;
  double f_statistic = 0;
  double p_value = 1;
  bool accepted = false;
};

struct ModelChoiceOptions {
  double significance = 1e-3;  // a parameter is freed when chance is less likely than this
  // Offers k1, k2, k3, p1, p2 only: the lens model of the paper.
  bool distortion_only = false;
};

struct ChosenModel {
  BundleResult bundle;    // the solution with the accepted parameters
  BundleOptions options;  // that led to it
  std::vector<ModelTest> tests;
};

// Frees parameters of the lens (k1, p1 p2, k2, k3, residual telecentricity, aspect, a lens per
// view) and of the target (bow of the boards) step by step, each kept when a likelihood-ratio test
// finds it less likely than the significance by chance, then takes back in reverse order what is no
// longer needed beside the rest (MODEL.md 6). What `options` frees is always free. A step whose fit
// does not converge is not offered further: the data cannot tell. Starts from `start`, perfect in
// all that is not free; `options`
// says how to solve. Fails as AdjustBundle does.
Result<ChosenModel> ChooseModel(const CalibrationData& data, const ArrayState& start,
                                const BundleOptions& options, const ModelChoiceOptions& choice);

// P(chi-square with `degrees` degrees of freedom > x).
double ChiSquareTail(double x, int degrees);

}  // namespace telestrain
