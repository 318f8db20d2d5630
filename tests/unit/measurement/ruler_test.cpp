#include "measurement/ruler.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/calibration/synthetic_array.h"
#include "unit/measurement/certificate_covariance.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::Observe;
using testing_support::Random;
using testing_support::SyntheticArray;

// Crosses of one ruler image, turned a little and somewhere in the field.
void AddRuler(SyntheticArray& array, const std::string& image, double length_mm, double noise_px,
              Random& random, std::vector<CrossObservation>& crosses) {
  array.session.ruler_images.push_back(image);
  const Eigen::Vector3d direction =
      Eigen::Vector3d(1, random.Uniform(-0.01, 0.01), random.Uniform(-0.02, 0.02)).normalized();
  const Eigen::Vector3d middle(random.Uniform(-1, 1), random.Uniform(-1, 1),
                               random.Uniform(-0.8, 0.8));
  for (std::size_t v = 0; v < array.views.size(); ++v) {
    const double side = array.views[v].group == "A" ? -0.5 : 0.5;
    crosses.push_back({image,
                       array.views[v].name,
                       Observe(array, v, middle + side * length_mm * direction, noise_px, random),
                       {}});
  }
}

TEST(Ruler, ErrorsLieWithinTheirStatedUncertainty) {
  int within = 0, total = 0;
  double squares = 0, predicted = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    testing_support::SyntheticOptions options;
    options.seed = seed;
    SyntheticArray array = MakeSyntheticArray(options);
    const auto calibration = Calibrate(array.session, array.boards);
    ASSERT_TRUE(calibration.ok());
    Random random(1000 + seed);
    std::vector<CrossObservation> crosses;
    for (int i = 0; i < 40; ++i)
      AddRuler(array, "ruler_" + std::to_string(i), 27.6, 0.1, random, crosses);
    const auto lengths = MeasureRuler(array.session, calibration->bundle.state.array, crosses);
    for (const RulerLength& length : lengths) {
      ASSERT_TRUE(length.rejected_because.empty());
      within += std::abs(length.error_um) < 2 * length.standard_uncertainty_um;
      squares += length.error_um * length.error_um;
      predicted += length.standard_uncertainty_um * length.standard_uncertainty_um;
      ++total;
    }
  }
  // 95.4 % of 320 within 2 u; 3 sigma of the binomial is 11.
  EXPECT_GE(within, 294);
  EXPECT_LE(within, 317);
  // measurement-model section 10: 0.44 um at 0.1 px.
  EXPECT_NEAR(std::sqrt(squares / total), 0.44, 0.06);
  EXPECT_NEAR(std::sqrt(predicted / total), 0.44, 0.02);
}

TEST(Ruler, IsRightThroughALeaningLensThatIsKnown) {
  SyntheticArray array = MakeSyntheticArray({});
  array.lens.telecentricity_per_mm = 2e-4;  // 0.02 %/mm
  ArrayCalibration known;
  known.lenses = {array.lens};
  known.views = array.views;
  known.covariance = Eigen::MatrixXd::Zero(known.ParameterCount(), known.ParameterCount());
  known.covariance_of_noise = known.covariance;
  ArrayCalibration unaware = known;
  unaware.lenses.front().telecentricity_per_mm = 0;
  Random random(8);
  std::vector<CrossObservation> crosses;
  for (int i = 0; i < 40; ++i)
    AddRuler(array, "ruler_" + std::to_string(i), 27.6, 0, random, crosses);
  // Rounding of 14 mm times 1 / sin 30 degrees, some operations.
  EXPECT_LT(Summarise(MeasureRuler(array.session, known, crosses)).max_abs_error_um, 1e-9);
  // The images move by kappa times the depth, 0.8 mm, times the 2.8 mm to the lens's axis, at both
  // ends: 0.4 um each; distortion of the views' common frame is not undone here.
  const RulerSummary off = Summarise(MeasureRuler(array.session, unaware, crosses));
  EXPECT_GT(off.max_abs_error_um, 0.1);
  RecordProperty("sd_um", std::to_string(off.sd_error_um));
  RecordProperty("max_um", std::to_string(off.max_abs_error_um));
}

TEST(Ruler, CertificatesEnterTheBudget) {
  SyntheticArray array = MakeSyntheticArray({});
  array.session.ruler.sigma_length_um = 0.3;
  const auto calibration = Calibrate(array.session, array.boards);
  ASSERT_TRUE(calibration.ok());
  ArrayCalibration known = calibration->bundle.state.array;
  ASSERT_EQ(ToText(known.model), "none");
  known.covariance =
      known.covariance_of_noise + testing_support::CovarianceOfSeparation(known, 0.25e-3);
  Random random(3);
  std::vector<CrossObservation> crosses;
  AddRuler(array, "r.png", 27.6, 1e-4, random, crosses);
  const auto lengths = MeasureRuler(array.session, known, crosses);
  ASSERT_EQ(lengths.size(), 1u);
  const std::vector<BudgetLine>& budget = lengths[0].budget;
  ASSERT_EQ(budget.size(), 4u);
  EXPECT_EQ(budget[2].source, "target certificate");
  // The ruler lies within 0.02 of the boards' direction: cos differs from 1 by 2e-4.
  EXPECT_NEAR(budget[2].standard_uncertainty, 0.25, 1e-3);
  EXPECT_NEAR(budget[3].standard_uncertainty, 0.3, 0);
  EXPECT_NEAR(lengths[0].standard_uncertainty_um, std::hypot(0.25, 0.3), 0.02);
}

TEST(Ruler, NoisyCrossesAreMeasuredAndForeignOnesAreRejected) {
  SyntheticArray array = MakeSyntheticArray({});
  const auto calibration = Calibrate(array.session, array.boards);
  ASSERT_TRUE(calibration.ok());
  Random random(5);
  std::vector<CrossObservation> crosses;
  constexpr int kCount = 100;
  for (int i = 0; i < kCount; ++i)
    AddRuler(array, "ruler_" + std::to_string(i), 27.6, 0.78, random, crosses);
  // 4 sigma of a cross are 5.7 of its residual: none of 200 ends is rejected by chance.
  for (const auto& length : MeasureRuler(array.session, calibration->bundle.state.array, crosses))
    EXPECT_EQ(length.rejected_because, "");
  // A noisy end does not excuse a foreign cross at the other.
  for (std::size_t view = 0; view < crosses.size(); view += 4) {
    crosses[view].center->pixel += Eigen::Vector2d(16, 16);
    for (const std::size_t other : {view + 2, view + 3})
      crosses[other].center->covariance_px2 = 9 * Eigen::Matrix2d::Identity();
  }
  for (const auto& length : MeasureRuler(array.session, calibration->bundle.state.array, crosses))
    EXPECT_NE(length.rejected_because.find("do not agree"), std::string::npos);
}

TEST(Ruler, AMissingCrossIsARejectionWithItsReason) {
  SyntheticArray array = MakeSyntheticArray({});
  const auto calibration = Calibrate(array.session, array.boards);
  ASSERT_TRUE(calibration.ok());
  Random random(3);
  std::vector<CrossObservation> crosses;
  AddRuler(array, "r.png", 27.6, 0.1, random, crosses);
  crosses[2].center.reset();
  crosses[2].rejected_because = "no cross in the view";
  const auto lengths = MeasureRuler(array.session, calibration->bundle.state.array, crosses);
  EXPECT_EQ(lengths[0].rejected_because, "B1: no cross in the view");
  EXPECT_EQ(Summarise(lengths).count, 0);
  EXPECT_EQ(RulerCsv(lengths), "image,length_mm,error_um,standard_uncertainty_um\n");
}

}  // namespace
}  // namespace telestrain
