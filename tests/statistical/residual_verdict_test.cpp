// How often the verdict on residuals is wrong: false alarms on calibrations of pure noise, and
// names given to planted faults that are near what can be seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "unit/diagnostics/fitted_array.h"

namespace telestrain {
namespace {

using testing_support::FitArray;
using testing_support::FitOptions;
using testing_support::ShiftCorners;
using testing_support::SyntheticArray;

FitOptions Numbered(int number) {
  FitOptions options;
  options.synthetic.seed = 5000 + static_cast<std::uint64_t>(number);
  options.synthetic.poses = number % 2 ? 9 : 6;
  options.synthetic.noise_px = number % 4 < 2 ? 0.1 : 0.003;
  options.synthetic.k1_per_mm2 = 1e-5;
  options.bundle.model.distortion[0] = true;
  options.bundle.model.per_view = number % 3 == 0;
  return options;
}

TEST(ResidualVerdict, CallsNoiseNoise) {
  constexpr int kCalibrations = 240;
  int patterns = 0, not_normal = 0, unknown = 0, spatial = 0, trend = 0, normality = 0;
  for (int i = 0; i < kCalibrations; ++i) {
    const ResidualVerdict verdict = FitArray(Numbered(i)).Judge();
    patterns += verdict.kind == ResidualVerdict::Kind::kPattern;
    not_normal += verdict.kind == ResidualVerdict::Kind::kNotNormal;
    unknown += !verdict.findings.empty() && verdict.findings[0].kind == PatternKind::kUnknown;
    spatial += verdict.noise.SmallestSpatialP() < 0.05;
    trend += verdict.noise.SmallestTrendP() < 0.05;
    normality += verdict.noise.normality.p_value < 0.05;
  }
  std::cout << "of " << kCalibrations << ": patterns " << patterns << " (unknown " << unknown
            << "), not normal " << not_normal << "; at 0.05: spatial " << spatial << ", trend "
            << trend << ", normality " << normality << "\n";
  EXPECT_LE(patterns + not_normal, 0.02 * kCalibrations);
  const double most = 0.05 * kCalibrations + 3 * std::sqrt(0.05 * 0.95 * kCalibrations);
  EXPECT_LE(spatial, most);
  EXPECT_LE(trend, most);
  EXPECT_LE(normality, most);
}

// Named first, or beside the first as hardly to be told from it.
bool Names(const ResidualVerdict& verdict, PatternKind kind, int view, const std::string& name) {
  if (verdict.findings.empty()) return false;
  const PatternFinding& first = verdict.findings.front();
  const auto& others = first.alternatives;
  return (first.kind == kind && first.view == view) ||
         std::find(others.begin(), others.end(), name) != others.end();
}

struct Planted {
  const char* what;
  PatternKind kind;
  int view;
  std::string name;  // as an alternative
  std::function<void(FitOptions&)> plant;
};

void PlantDrift(FitOptions& options, const Eigen::Vector2d& drift_px) {
  options.corners = [drift_px](SyntheticArray& array) {
    for (std::size_t image = 0; image < 18; ++image)
      ShiftCorners(array, image, 1, [&](const Eigen::Vector2d&) {
        return Eigen::Vector2d(drift_px * (static_cast<double>(image) / 17 - 0.5));
      });
  };
}

void PlantK1(FitOptions& options) {
  options.truth = [](SyntheticArray& array) {
    array.lens_of_view.assign(4, array.lens);
    array.lens_of_view[2].distortion[0] = 5e-6;
  };
}

void PlantShift(FitOptions& options) {
  options.corners = [](SyntheticArray& array) {
    ShiftCorners(array, 4, 3, [](const Eigen::Vector2d&) { return Eigen::Vector2d(0.12, 0); });
  };
}

// An even drift along v is nearly taken up by the poses, along u only by half.
std::vector<Planted> WeakFaults() {
  const std::string drift = "a drift over the images (view A2)";
  return {{"k1 of one view, 5e-6 per mm2", PatternKind::kRadialK1, 2, "", PlantK1},
          {"drift of one view along u, 0.06 px", PatternKind::kViewDrift, 1, drift,
           [](FitOptions& o) {
             PlantDrift(o, {0.06, 0});
           }},
          {"drift of one view along v, 1 px", PatternKind::kViewDrift, 1, drift,
           [](FitOptions& o) {
             PlantDrift(o, {0, 1});
           }},
          {"one board shifted by 0.12 px", PatternKind::kBoardMisfit, 3, "", PlantShift}};
}

TEST(ResidualVerdict, NamesWeakFaults) {
  constexpr int kRepeats = 40;
  for (const Planted& fault : WeakFaults()) {
    int named = 0, found = 0;
    for (int i = 0; i < kRepeats; ++i) {
      FitOptions options;
      options.synthetic.seed = 900 + static_cast<std::uint64_t>(i);
      fault.plant(options);
      const ResidualVerdict verdict = FitArray(options).Judge();
      found += verdict.kind == ResidualVerdict::Kind::kPattern;
      named += Names(verdict, fault.kind, fault.view, fault.name);
    }
    std::cout << fault.what << ": a pattern in " << found << ", named in " << named << " of "
              << kRepeats << "\n";
    // Strong enough to be named always but where noise makes two views or boards alike.
    EXPECT_GE(named, 0.8 * kRepeats) << fault.what;
  }
}

}  // namespace
}  // namespace telestrain
