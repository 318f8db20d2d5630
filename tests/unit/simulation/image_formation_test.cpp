#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/blurred_checkerboard.h"
#include "simulation/plate_image.h"

namespace telestrain {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

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

// Place of the one edge that the pixels from `first` to `last` of a row or column cross: the
// integral of a blurred step does not depend on the blur (pixel sums and integrals differ by
// exp(-2 pi^2 sigma^2), here 6e-7 of the contrast).
double EdgePlace(const GrayImage& image, bool along_row, int fixed, int first, int last) {
  const auto gray = [&](int i) {
    return static_cast<double>(along_row ? image.At(i, fixed) : image.At(fixed, i));
  };
  double sum = 0;
  for (int i = first; i <= last; ++i) sum += (gray(i) - gray(last)) / (gray(first) - gray(last));
  return first - 0.5 + sum;
}

// Checks the edge from the saddle along the plate's direction `along`, near 0.75 mm from it.
void ExpectEdgeExact(const VirtualInstrument& instrument, const PlatePose& pose,
                     const GrayImage& image, const Eigen::Vector3d& along) {
  const TelecentricView& view = instrument.views[0].view;
  const auto pixel_of = [&](double mm) {
    return Project(instrument.lens, view, pose.InArray(mm * along));
  };
  const Eigen::Vector2d step = pixel_of(0.8) - pixel_of(0.7);
  const bool along_row = std::abs(step.y()) > std::abs(step.x());
  const int other = along_row ? 1 : 0, axis = 1 - other;
  const int fixed = static_cast<int>(std::lround(pixel_of(0.75)[other]));
  double mm = 0.75;  // where the edge crosses that row or column
  for (int i = 0; i < 10; ++i)
    mm += (fixed - pixel_of(mm)[other]) / (pixel_of(mm + 0.5)[other] - pixel_of(mm - 0.5)[other]);
  const double expected = pixel_of(mm)[axis];
  const int middle = static_cast<int>(std::lround(expected));
  const double found = EdgePlace(image, along_row, fixed, middle - 12, middle + 12);
  EXPECT_NEAR(found, expected, 1e-3) << "edge along " << along.transpose();
}

TEST(PlateImage, EdgesLieWhereTheModelPutsThemAtEveryAngle) {
  for (const double distortion : {0.0, 1e-3}) {
    const VirtualInstrument instrument = OneView(distortion);
    for (const double angle_deg : {0.0, 7.0, 23.0, 45.0, 71.0, 90.0}) {
      SCOPED_TRACE("angle " + std::to_string(angle_deg));
      const PlatePose pose = PoseTurnedBy(angle_deg);
      const GrayImage image = RenderPlate(instrument, LargeCross(), pose, 1);
      for (const Eigen::Vector3d& along : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                           Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)})
        ExpectEdgeExact(instrument, pose, image, along);
    }
  }
}

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
  const TelecentricView& view = instrument.views[0].view;
  for (const double angle_deg : {0.0, 10.0, 33.0, 45.0, 80.0}) {
    PlatePose pose = PoseTurnedBy(angle_deg);
    // Moves the saddle onto the middle of a pixel, where symmetric differences see its symmetry.
    const Eigen::Vector2d ideal_mm = instrument.lens.IdealFromPixel({90, 120});
    pose.origin_in_array_mm = view.PointOnRay(ideal_mm);
    const GrayImage image = RenderPlate(instrument, LargeCross(), pose, 1);
    EXPECT_LT(StepToSaddle(image, {90, 120}).norm(), 0.002) << angle_deg;
  }
}

// The pattern's mean over the blur by brute force, on a grid of +-6 sigma.
double BrightnessByQuadrature(const Eigen::Vector2d& point, const Eigen::Matrix2d& cov) {
  const Eigen::Matrix2d root = cov.llt().matrixL();
  constexpr int kSteps = 600;
  constexpr double kHalf = 6;
  double sum = 0, weights = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const Eigen::Vector2d z(kHalf * ((2.0 * i + 1) / kSteps - 1),
                              kHalf * ((2.0 * j + 1) / kSteps - 1));
      const Eigen::Vector2d p = point + root * z;
      const int column = static_cast<int>(std::floor(p.x() + 2));  // 4 x 3 squares of 1 mm
      const int row = static_cast<int>(std::floor(p.y() + 1.5));
      const bool dark = column >= 0 && column < 4 && row >= 0 && row < 3 && (column + row) % 2 == 0;
      const double weight = std::exp(-z.squaredNorm() / 2);
      sum += weight * (dark ? 0 : 1);
      weights += weight;
    }
  return sum / weights;
}

TEST(BlurredCheckerboard, AgreesWithQuadratureAtSaddlesEdgesAndBorders) {
  Eigen::Matrix2d cov;
  cov << 0.0064, 0.0035, 0.0035, 0.0049;  // sigma 0.08 and 0.07 mm, correlation 0.62
  const BlurredCheckerboard board(3, 2, 1.0, cov);
  for (const auto& [x, y] : {std::pair{0.03, 0.51},
                             {-0.05, 0.45},
                             {1.97, 1.46},
                             {-2.05, -1.52},
                             {0.5, 0.52},
                             {2.04, 0.1},
                             {0.98, -1.55},
                             {1.02, -0.47}})
    // The quadrature's error: jumps between nodes 0.02 sigma apart.
    EXPECT_NEAR(board.Brightness({x, y}), BrightnessByQuadrature({x, y}, cov), 2e-3)
        << x << ' ' << y;
}

TEST(BlurredCheckerboard, IsDarkInItsFirstAndLastSquareAndBrightAround) {
  const BlurredCheckerboard board(13, 9, 0.3, 1e-4 * Eigen::Matrix2d::Identity());
  EXPECT_NEAR(board.Brightness({-1.95, -1.35}), 0, 1e-9);
  EXPECT_NEAR(board.Brightness({1.95, 1.35}), 0, 1e-9);
  EXPECT_NEAR(board.Brightness({-1.65, -1.35}), 1, 1e-9);
  EXPECT_NEAR(board.Brightness({-2.4, -1.35}), 1, 1e-9);
  EXPECT_NEAR(board.Brightness({0, 3}), 1, 1e-9);
  EXPECT_NEAR(board.Brightness({0, 0}), 0.5, 1e-9);
}

TEST(MeanSignProduct, HasTheKnownValueAtTheOrigin) {
  // Sheppard: E[sgn X sgn Y] = 2/pi asin(rho).
  for (const double rho : {-0.6, -0.1, 0.0, 0.3, 0.7})
    EXPECT_NEAR(MeanSignProduct(0, 0, rho), 2 / std::numbers::pi * std::asin(rho), 1e-6) << rho;
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
