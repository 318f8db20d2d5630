#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/plate_image.h"
#include "simulation/scene_image.h"

namespace telestrain {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kHalfProfile_px = 24;

// One oblique view of the whole of a small sensor, with or without a lens that distorts.
VirtualInstrument OneView(double distortion_per_mm2) {
  VirtualInstrument instrument;
  instrument.width_px = 240;
  instrument.height_px = 200;
  instrument.lens.magnification_px_per_mm = 60;
  instrument.lens.center_px = {119.5, 99.5};
  instrument.lens.distortion = {distortion_per_mm2, 0, 1e-5, -2e-5, 0};
  instrument.blur_sigma_px = std::sqrt(0.8 * 0.8 + 1.0 / 12);
  InstrumentView view;
  view.view = {"A1", "A", ExpRotation({30 * kDegree, 0, 0}).topRows<2>(), {0, 0}};
  view.region = {0, 0, 240, 200};
  view.viewing_direction = view.view.RayDirection();
  instrument.views.push_back(view);
  return instrument;
}

// A cross of 2 x 2 large squares: one saddle, four long edges.
TargetSpec LargeCross() {
  TargetSpec plate;
  plate.columns = plate.rows = 1;
  plate.square_mm = 1.5;
  plate.boards = {{"A", {0, 0, 0}, 0}};
  return plate;
}

PlatePose PoseTurnedBy(double angle_deg) {
  return {ExpRotation({0.05, -0.03, angle_deg * kDegree}), {0.013, -0.021, 0.1}};
}

// Inverse of the normal distribution function, by bisection.
double Probit(double share) {
  double low = -8, high = 8;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::numbers::sqrt2) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Where the profile of an edge crosses one half, near the middle of `profile`: the probits of its
// inner levels lie on a line for a Gaussian blur and on a smooth curve for one that changes along
// the profile; the root of the parabola through them.
double CrossingOf(const std::vector<double>& profile) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const double middle = 0.5 * static_cast<double>(profile.size() - 1);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double share = (profile[i] - profile.front()) / (profile.back() - profile.front());
    if (share < 0.02 || share > 0.98) continue;
    const double x = static_cast<double>(i) - middle;
    const Eigen::Vector3d powers(1, x, x * x);
    normal += powers * powers.transpose();
    right += powers * Probit(share);
  }
  const Eigen::Vector3d c = normal.ldlt().solve(right);
  double root = -c[0] / c[1];
  for (int i = 0; i < 5; ++i)
    root -= (c[0] + root * (c[1] + root * c[2])) / (c[1] + 2 * root * c[2]);
  return middle + root;
}

// Checks the edge from the saddle along the plate's direction `along`, `mm` away from the saddle,
// on the row or column that crosses it there.
void ExpectEdgeExact(const VirtualInstrument& instrument, const PlatePose& pose,
                     const GrayImage& image, const Eigen::Vector3d& along, double mm) {
  const auto pixel_of = [&](double place_mm) {
    return instrument.Project(instrument.views[0], pose.InArray(place_mm * along));
  };
  const Eigen::Vector2d step = pixel_of(mm + 0.1) - pixel_of(mm - 0.1);
  const bool along_row = std::abs(step.y()) > std::abs(step.x());
  const int other = along_row ? 1 : 0, axis = 1 - other;
  const int fixed = static_cast<int>(std::lround(pixel_of(mm)[other]));
  for (int i = 0; i < 10; ++i)
    mm += (fixed - pixel_of(mm)[other]) / (pixel_of(mm + 0.5)[other] - pixel_of(mm - 0.5)[other]);
  const double expected = pixel_of(mm)[axis];
  const int first = static_cast<int>(std::lround(expected)) - kHalfProfile_px;
  std::vector<double> profile;
  for (int i = first; i <= first + 2 * kHalfProfile_px; ++i)
    profile.push_back(along_row ? image.At(i, fixed) : image.At(fixed, i));
  EXPECT_NEAR(first + CrossingOf(profile), expected, 1e-3)
      << "edge along " << along.transpose() << " at " << mm << " mm";
}

struct Optics {
  const char* name;
  double distortion_per_mm2, pupil_sigma, telecentricity_per_mm;
  Eigen::Vector3d vibration_in_array_mm;
};

class PlateImageOf : public testing::TestWithParam<Optics> {};

TEST_P(PlateImageOf, EdgesLieWhereTheModelPutsThemAtEveryAngle) {
  VirtualInstrument instrument = OneView(GetParam().distortion_per_mm2);
  instrument.pupil_sigma = GetParam().pupil_sigma;
  instrument.telecentricity_per_mm = GetParam().telecentricity_per_mm;
  instrument.vibration_in_array_mm = GetParam().vibration_in_array_mm;
  std::vector<double> angles_deg{45, 90};
  for (int i = 0; i < 18; ++i) angles_deg.push_back(5.1 * i);
  for (const double angle_deg : angles_deg) {
    SCOPED_TRACE("angle " + std::to_string(angle_deg));
    PlatePose pose = PoseTurnedBy(angle_deg);
    pose.origin_in_array_mm += 1.5 * instrument.views[0].viewing_direction;  // out of focus
    const GrayImage image = RenderPlate(instrument, LargeCross(), pose, 2);
    for (const Eigen::Vector3d& along : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                         Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)})
      for (double mm = 0.6; mm < 0.95; mm += 0.05)
        ExpectEdgeExact(instrument, pose, image, along, mm);
  }
}

INSTANTIATE_TEST_SUITE_P(Optics, PlateImageOf,
                         testing::Values(Optics{"Plain", 0, 0, 0, {0, 0, 0}},
                                         Optics{"Distorted", 1e-3, 0, 0, {0, 0, 0}},
                                         Optics{"Defocused", 0, 0.012, 0, {0, 0, 0}},
                                         Optics{"DefocusedAndDistorted", 1e-3, 0.012, 0, {0, 0, 0}},
                                         Optics{"Leaning", 1e-3, 0.012, 0.01, {0, 0, 0}},
                                         Optics{"Vibrating", 0, 0, 0, {0.02, 0.01, 0.01}}),
                         [](const auto& test) { return test.param.name; });

// One Newton step from `pixel` to the saddle, with symmetric differences over one pixel.
Eigen::Vector2d StepToSaddle(const GrayImage& image, const Eigen::Vector2i& pixel) {
  const auto gray = [&](int dx, int dy) {
    return static_cast<double>(image.At(pixel.x() + dx, pixel.y() + dy));
  };
  const Eigen::Vector2d gradient((gray(1, 0) - gray(-1, 0)) / 2, (gray(0, 1) - gray(0, -1)) / 2);
  const double xy = (gray(1, 1) - gray(-1, 1) - gray(1, -1) + gray(-1, -1)) / 4;
  Eigen::Matrix2d hessian;
  hessian << gray(1, 0) - 2 * gray(0, 0) + gray(-1, 0), xy, xy,
      gray(0, 1) - 2 * gray(0, 0) + gray(0, -1);
  return -hessian.inverse() * gradient;
}

TEST(PlateImage, SaddlesLieWhereTheModelPutsThem) {
  VirtualInstrument instrument = OneView(1e-3);
  instrument.views[0].illumination_slope = {0.06, -0.04};
  for (const double angle_deg : {0.0, 10.0, 33.0, 45.0, 80.0}) {
    PlatePose pose = PoseTurnedBy(angle_deg);
    // Moves the saddle onto the middle of a pixel, where symmetric differences see its symmetry.
    const Eigen::Vector2d ideal_mm = instrument.lens.IdealFromPixel({90, 120});
    pose.origin_in_array_mm = instrument.RayOf(instrument.views[0], ideal_mm).point_in_array_mm;
    const GrayImage image = RenderPlate(instrument, LargeCross(), pose, 1);
    // The slope of the light moves the saddle of the grey levels itself by some 1e-3 px.
    EXPECT_LT(StepToSaddle(image, {90, 120}).norm(), 0.002) << angle_deg;
  }
}

TEST(PlateImage, ShowsCornersWhereTheProjectionPutsThemThroughLeaningRays) {
  VirtualInstrument instrument = OneView(1e-3);
  instrument.telecentricity_per_mm = 0.01;
  const InstrumentView& view = instrument.views[0];
  for (const double depth_mm : {-1.5, 0.7, 1.5}) {
    PlatePose pose = PoseTurnedBy(25);
    const ChiefRay ray = instrument.RayOf(view, instrument.lens.IdealFromPixel({30, 160}));
    pose.origin_in_array_mm = ray.point_in_array_mm + depth_mm * ray.direction_in_array;
    const Eigen::Vector2d truth_px = instrument.Project(view, pose.origin_in_array_mm);
    EXPECT_LT((truth_px - Eigen::Vector2d(30, 160)).norm(), 1e-9);  // Newton's 1e-13 mm, rounding
    EXPECT_NEAR(view.BeyondFocus_mm(pose.origin_in_array_mm), depth_mm, 1e-12);
    // 1 % per mm moves this corner by about 1.5 px.
    EXPECT_GT((Project(instrument.lens, view.view, pose.origin_in_array_mm) - truth_px).norm(),
              0.5);
    const GrayImage image = RenderPlate(instrument, LargeCross(), pose, 1);
    EXPECT_LT(StepToSaddle(image, {30, 160}).norm(), 1e-3) << depth_mm;
  }
}

TEST(PlateImage, InvertedIsTheSamePlateInTheOtherTone) {
  const VirtualInstrument instrument = OneView(1e-3);
  const PlatePose pose = PoseTurnedBy(12);
  const GrayImage image = RenderPlate(instrument, LargeCross(), pose, 1);
  const GrayImage inverted =
      RenderPlate(instrument, LargeCross(), pose, 1, PlateTone::kBrightSquares);
  // Only the plate is in this image, so the two tones add up to their sum; float rounding.
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      ASSERT_NEAR(image.At(x, y) + inverted.At(x, y), 30 + 220, 1e-4);
}

TEST(PlateImage, VibrationBlursAcrossItsDirectionOnly) {
  VirtualInstrument instrument = OneView(0);
  const TelecentricView& view = instrument.views[0].view;
  PlatePose facing{view.Rotation().transpose(), {0, 0, 0}};
  const GrayImage still = RenderPlate(instrument, LargeCross(), facing, 1);
  instrument.vibration_in_array_mm = view.axes_in_array.row(0).transpose() * 2.0 / 60;  // 2 px
  const GrayImage moving = RenderPlate(instrument, LargeCross(), facing, 1);
  // The edge's slope in its middle is contrast / (sqrt(2 pi) sigma); over one pixel, less by
  // 1 / (24 sigma^2): the ratio of both images' slopes.
  const auto slope = [](const GrayImage& image, int dx, int dy) {
    const int x = dx == 1 ? 119 : 160, y = dy == 1 ? 99 : 130;
    return std::abs(static_cast<double>(image.At(x + dx, y + dy) - image.At(x, y)));
  };
  const double sigma2 = instrument.blur_sigma_px * instrument.blur_sigma_px;
  const double expected =
      std::erf(0.5 / std::sqrt(2 * (sigma2 + 4))) / std::erf(0.5 / std::sqrt(2 * sigma2));
  EXPECT_NEAR(slope(moving, 1, 0) / slope(still, 1, 0), expected, 1e-4);
  EXPECT_NEAR(slope(moving, 0, 1) / slope(still, 0, 1), 1, 1e-4);
}

TEST(SceneImage, DustDimsTheSamePixelsOfEveryImageByTheSameShare) {
  VirtualInstrument clean = OneView(0), dusty = clean;
  dusty.dust = {{{50.3, 80.8}, 9, 0.4}, {{200, 3}, 15, 0.6}};
  const PlatePose pose = PoseTurnedBy(10), other = PoseTurnedBy(50);
  const auto share = [&](const PlatePose& at, int x, int y) {
    return RenderPlate(dusty, LargeCross(), at, 1).At(x, y) /
           RenderPlate(clean, LargeCross(), at, 1).At(x, y);
  };
  for (const auto& [x, y] : {std::pair{50, 81}, {56, 85}, {199, 3}, {190, 10}}) {
    EXPECT_NEAR(share(pose, x, y), share(other, x, y), 1e-6);
    EXPECT_LT(share(pose, x, y), 0.999F);
  }
  EXPECT_NEAR(share(pose, 50, 81), 0.6, 1e-3);
  EXPECT_EQ(share(pose, 120, 100), 1);
}

TEST(IdealOfRow, InvertsTheDistortionAtEveryPixel) {
  TelecentricLens lens;
  lens.magnification_px_per_mm = 227.27;
  lens.center_px = {1295.5, 971.5};
  lens.distortion = {4e-4, 0, 2e-5, -3e-5, 0};  // 2 % in the corner
  const auto ideal_mm = IdealOfRow(lens, 1296, 3, 1296);
  for (int x = 0; x < 1296; ++x)
    ASSERT_LT((ideal_mm[x] - lens.IdealFromPixel({1296 + x, 3})).norm(), 1e-9) << x;
}

TEST(PlateImage, DoesNotDependOnTheNumberOfThreads) {
  const VirtualInstrument instrument = OneView(1e-3);
  const PlatePose pose = PoseTurnedBy(5);
  EXPECT_EQ(RenderPlate(instrument, LargeCross(), pose, 1).pixels,
            RenderPlate(instrument, LargeCross(), pose, 3).pixels);
}

}  // namespace
}  // namespace telestrain
