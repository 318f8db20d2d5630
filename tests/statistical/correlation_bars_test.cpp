// What the correlation must reach on exact images of both kinds of speckle: soft spots and paint.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "correlation/correlation_field.h"
#include "correlation/image_filters.h"
#include "tests/unit/correlation/painted_discs.h"

namespace telestrain {
namespace {

constexpr int kSide = 460, kSubset_px = 33;
const PixelRegion kRegion{0, 0, kSide, kSide};
const Eigen::Vector2d kAbout = kRegion.Middle();
// Subsets do not overlap.
const std::vector<Eigen::Vector2i> kCenters = GridOfCenters(kRegion, 36, kSubset_px);

ShapeFunction Shift(double u_px, double v_px) {
  ShapeFunction map;
  map.displacement_px = {u_px, v_px};
  return map;
}

CorrelationOptions Options(Interpolation interpolation = Interpolation::kQuintic) {
  return {.subset_px = kSubset_px, .interpolation = interpolation, .threads = 1};
}

std::vector<Eigen::Vector2d> Displacements(const GrayImage& before, const GrayImage& after,
                                           const CorrelationOptions& options,
                                           std::vector<SubsetMatch>* all = nullptr) {
  const CorrelationReference reference(before, kRegion, options);
  const auto matches =
      CorrelatePoints(reference, kCenters, {after, kRegion, options}, {ShapeFunction()});
  std::vector<Eigen::Vector2d> displacements;
  for (const SubsetMatch& match : matches) {
    EXPECT_TRUE(match.ok()) << ToText(match.status);
    displacements.push_back(match.shape.displacement_px);
  }
  if (all) *all = matches;
  return displacements;
}

// Largest mean error over shifts of 0 to 1 px, without noise.
template <class Pattern>
double WorstBias_px(const Pattern& pattern, Interpolation interpolation) {
  const GrayImage before = pattern.Render(kSide, kSide);
  double worst_px = 0;
  for (int tenth = 0; tenth <= 10; ++tenth) {
    const ShapeFunction map = Shift(0.1 * tenth, 1 - 0.1 * tenth);
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& found :
         Displacements(before, pattern.Render(kSide, kSide, map), Options(interpolation)))
      mean += (found - map.displacement_px) / static_cast<double>(kCenters.size());
    worst_px = std::max(worst_px, mean.cwiseAbs().maxCoeff());
  }
  std::printf("largest bias %.3f mpx\n", 1000 * worst_px);
  return worst_px;
}

TEST(CorrelationBars, BiasOfSoftSpeckle) {
  const Speckle speckle(1, kSide, kSide, 2.0);
  EXPECT_LE(WorstBias_px(speckle, Interpolation::kQuintic), 0.2e-3);
  EXPECT_LE(WorstBias_px(speckle, Interpolation::kCubic), 0.5e-3);
}

TEST(CorrelationBars, BiasOfPaint) {
  const PaintedDiscs paint(2, kSide, kSide);
  EXPECT_LE(WorstBias_px(paint, Interpolation::kQuintic), 0.2e-3);
  EXPECT_LE(WorstBias_px(paint, Interpolation::kCubic), 2.5e-3);
}

// Of displacements from noise of one grey level, for every centre.
struct Variances {
  // 2 / sum gx^2 and the same of gy with the slopes of the formula: the least that can be.
  std::vector<Eigen::Vector2d> least;
  // What the matching of two blurred images reaches: the noise of u is sum h (b * n) / sum h (b *
  // g) with the blur b, the slopes h that the engine takes of the blurred image and the true ones
  // g, so its variance is 2 sum (b * h)^2 / (sum h (b * g))^2.
  std::vector<Eigen::Vector2d> attained;
};

template <class Pattern>
GrayImage SlopeOf(const Pattern& pattern, int axis) {
  constexpr double kStep_px = 1e-3;
  const Eigen::Vector2d step = kStep_px * Eigen::Vector2d::Unit(axis);
  GrayImage slopes{kSide, kSide, 255, {}};
  for (int k = 0; k < kSide * kSide; ++k) {
    const Eigen::Vector2d at(k % kSide, k / kSide);
    slopes.pixels.push_back(
        static_cast<float>((pattern.At(at + step) - pattern.At(at - step)) / (2 * kStep_px)));
  }
  return slopes;
}

template <class Pattern>
Variances VariancesOf(const Pattern& pattern) {
  const std::vector<float> blur = correlation::GaussianKernel(Options().prefilter_sigma_px);
  const std::vector<float> slope = correlation::SlopeKernel(Options().prefilter_sigma_px);
  const GrayImage clean = pattern.Render(kSide, kSide);
  Variances variances{std::vector<Eigen::Vector2d>(kCenters.size()),
                      std::vector<Eigen::Vector2d>(kCenters.size())};
  for (int axis = 0; axis < 2; ++axis) {
    const GrayImage g = SlopeOf(pattern, axis), blurred_g = correlation::Blur(g, blur);
    GrayImage h = clean;
    correlation::FilterSeparable(correlation::View(clean, kRegion), axis == 0 ? slope : blur,
                                 axis == 0 ? blur : slope, kRegion, 1, h.pixels.data(), kSide);
    const GrayImage blurred_h = correlation::Blur(h, blur);
    for (std::size_t i = 0; i < kCenters.size(); ++i) {
      double gg = 0, hg = 0, hh = 0;
      for (int k = 0; k < kSubset_px * kSubset_px; ++k) {
        const int x = kCenters[i].x() + k % kSubset_px - kSubset_px / 2;
        const int y = kCenters[i].y() + k / kSubset_px - kSubset_px / 2;
        gg += std::pow(g.At(x, y), 2);
        hg += static_cast<double>(h.At(x, y)) * blurred_g.At(x, y);
        hh += std::pow(blurred_h.At(x, y), 2);
      }
      variances.least[i][axis] = 2 / gg;
      variances.attained[i][axis] = 2 * hh / (hg * hg);
    }
  }
  return variances;
}

// Root mean squares over points and runs.
struct NoiseRatios {
  double to_limit = 0;      // what noise adds, in units of the least standard deviation
  double to_attained = 0;   // the same in units of what the blurred images attain
  double to_predicted = 0;  // the whole error, in units of the predicted standard deviation
};

template <class Pattern>
NoiseRatios MeasureNoise(const Pattern& pattern, double sigma_gray) {
  constexpr int kRuns = 36;
  constexpr double kShifts_px[] = {0, 0.25, 0.5};
  const GrayImage clean = pattern.Render(kSide, kSide);
  const Variances variances = VariancesOf(pattern);
  std::mt19937 random(3);
  Eigen::Vector2d limit = Eigen::Vector2d::Zero(), attained = limit, predicted = limit;
  for (double shift_px : kShifts_px) {
    const ShapeFunction map = Shift(shift_px, 1 - shift_px);
    const GrayImage moved = pattern.Render(kSide, kSide, map);
    const auto without_noise = Displacements(clean, moved, Options());
    for (int run = 0; run < kRuns / 3; ++run) {
      GrayImage before = clean, after = moved;
      AddNoise(sigma_gray, random, before);
      AddNoise(sigma_gray, random, after);
      std::vector<SubsetMatch> matches;
      const auto found = Displacements(before, after, Options(), &matches);
      for (std::size_t i = 0; i < found.size(); ++i) {
        const Eigen::Vector2d added = (found[i] - without_noise[i]).cwiseAbs2();
        limit += added.cwiseQuotient(variances.least[i]);
        attained += added.cwiseQuotient(variances.attained[i]);
        predicted += (found[i] - map.displacement_px)
                         .cwiseAbs2()
                         .cwiseQuotient(matches[i].covariance.diagonal().head<2>());
      }
    }
  }
  const double values = 2.0 * kRuns * static_cast<double>(kCenters.size());
  NoiseRatios ratios{std::sqrt(limit.sum() / values) / sigma_gray,
                     std::sqrt(attained.sum() / values) / sigma_gray,
                     std::sqrt(predicted.sum() / values)};
  std::printf("noise %.0f: %.3f of the limit, %.3f of the attained, %.3f of the predicted\n",
              sigma_gray, ratios.to_limit, ratios.to_attained, ratios.to_predicted);
  return ratios;
}

// 144 points x 36 runs x u and v know a standard deviation to 0.7 %.
TEST(CorrelationBars, NoiseOfSoftSpeckleIsAtTheLimitAndAsPredicted) {
  for (double sigma_gray : {1.0, 2.0}) {
    const NoiseRatios ratios = MeasureNoise(Speckle(1, kSide, kSide, 2.0), sigma_gray);
    EXPECT_NEAR(ratios.to_limit, 1, 0.05) << sigma_gray;
    EXPECT_NEAR(ratios.to_attained, 1, 0.05) << sigma_gray;
    EXPECT_NEAR(ratios.to_predicted, 1, 0.1) << sigma_gray;
  }
}

// The blur costs 10 % on paint (measured), twice the aim of 5 %: with less of it the bias is above
// 0.2 mpx. At noise of one grey level the prediction is 11 % high, since the misfit of the pattern
// that aliases counts as noise; only there more than 10 % are let pass, on the safe side.
TEST(CorrelationBars, NoiseOfPaintIsWhatTheBlurLeavesAndAsPredicted) {
  for (double sigma_gray : {1.0, 2.0}) {
    const NoiseRatios ratios = MeasureNoise(PaintedDiscs(2, kSide, kSide), sigma_gray);
    EXPECT_NEAR(ratios.to_attained, 1, 0.05) << sigma_gray;
    EXPECT_LT(ratios.to_predicted, 1.1) << sigma_gray;
    EXPECT_GT(ratios.to_predicted, sigma_gray < 2 ? 0.85 : 0.9) << sigma_gray;
  }
}

// Displacement gradient of the plane through displacements.
Eigen::Matrix2d PlaneGradient(const std::vector<Eigen::Vector2i>& centers,
                              const std::vector<Eigen::Vector2d>& displacements) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const Eigen::Vector3d basis(1, centers[i].x(), centers[i].y());
    normal += basis * basis.transpose();
    right += basis * displacements[i].transpose();
  }
  const Eigen::Matrix<double, 3, 2> plane = normal.inverse() * right;
  return plane.bottomRows<2>().transpose();
}

// The slope of the displacement where it passes zero, to which interpolation bias adds the most.
template <class Pattern>
void ExpectTrueStrainScale(const Pattern& pattern) {
  const GrayImage before = pattern.Render(kSide, kSide);
  for (double strain : {100e-6, 500e-6, 750e-6}) {
    ShapeFunction map;
    map.gradient << strain, 0, 0, -0.3 * strain;
    const auto found = Displacements(before, pattern.Render(kSide, kSide, map, kAbout), Options());
    const double scale = PlaneGradient(kCenters, found)(0, 0) / strain;
    std::printf("%.0f microstrain: scale %.5f\n", 1e6 * strain, scale);
    EXPECT_NEAR(scale, 1, 0.003) << strain;
  }
}

TEST(CorrelationBars, StrainScaleAboutZeroDisplacement) {
  ExpectTrueStrainScale(Speckle(1, kSide, kSide, 2.0));
  ExpectTrueStrainScale(PaintedDiscs(2, kSide, kSide));
}

// Green-Lagrange strain of the plane through a whole field, and its standard deviation from the
// predicted ones of the points.
struct FieldStrain {
  Eigen::Matrix2d strain;
  double sigma = 0;
};

FieldStrain StrainOfField(const GrayImage& before, const GrayImage& after) {
  FieldOptions options;
  options.correlation = Options();
  options.step_px = kSubset_px;
  options.region = PixelRegion{30, 30, before.width - 60, before.height - 60};  // when turned
  const CorrelationReference reference(before, {0, 0, before.width, before.height},
                                       options.correlation);
  std::vector<Eigen::Vector2i> centers;
  std::vector<Eigen::Vector2d> displacements;
  double variance = 0, spread = 0;
  for (const FieldPoint& point : Correlate(reference, after, options).points) {
    EXPECT_TRUE(point.match.ok());
    centers.push_back(point.center_px);
    displacements.push_back(point.match.shape.displacement_px);
    variance += point.match.covariance(0, 0);
    spread += std::pow(point.center_px.x() - 0.5 * (before.width - 1), 2);
  }
  const Eigen::Matrix2d g = PlaneGradient(centers, displacements);
  return {0.5 * (g + g.transpose() + g.transpose() * g),
          std::sqrt(variance / static_cast<double>(centers.size()) / spread)};
}

constexpr double kFieldPixels = 5e6;

template <class Pattern>
void ExpectNoFalseStrain(const Pattern& pattern, int side, const ShapeFunction& map) {
  GrayImage before = pattern.Render(side, side);
  GrayImage after = pattern.Render(side, side, map, Eigen::Vector2d::Constant(0.5 * (side - 1)));
  const FieldStrain clean = StrainOfField(before, after);
  std::mt19937 random(4);
  AddNoise(1, random, before);
  AddNoise(1, random, after);
  const FieldStrain noisy = StrainOfField(before, after);
  std::printf("false strain %.2f, with noise %.2f microstrain (sigma %.2f)\n",
              1e6 * clean.strain.cwiseAbs().maxCoeff(), 1e6 * noisy.strain.cwiseAbs().maxCoeff(),
              1e6 * noisy.sigma);
  const double noise = (noisy.strain - clean.strain).cwiseAbs().maxCoeff();
  EXPECT_LE(noise, 4 * noisy.sigma);
  // The noise of a plane falls with the square of the side.
  const double whole_field = side * static_cast<double>(side) / kFieldPixels;
  EXPECT_LE(clean.strain.cwiseAbs().maxCoeff() + 4 * noisy.sigma * whole_field, 1e-6);
}

// The bar of 1 microstrain holds for the full field of a camera of 5 Mpx; here a fifth of it is
// matched: what is left without noise, and four standard deviations of the noise on the full field.
TEST(CorrelationBars, RigidMotionGivesNoStrain) {
  constexpr int kLarge = 1000;
  const double angle = std::numbers::pi / 180;
  ShapeFunction turn;
  turn.gradient << std::cos(angle) - 1, -std::sin(angle), std::sin(angle), std::cos(angle) - 1;
  for (const ShapeFunction& map : {Shift(3.37, -1.62), turn}) {
    ExpectNoFalseStrain(Speckle(5, kLarge, kLarge, 2.0), kLarge, map);
    ExpectNoFalseStrain(PaintedDiscs(6, kLarge, kLarge), kLarge, map);
  }
}

}  // namespace
}  // namespace telestrain
