#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/plate_image.h"

namespace telestrain {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A view tilted by 38 deg against the plate, almost free of any blur but defocus.
VirtualInstrument WideAperture(double telecentricity_per_mm) {
  VirtualInstrument instrument;
  instrument.width_px = instrument.height_px = 101;
  instrument.lens.magnification_px_per_mm = 100;
  instrument.lens.center_px = {50, 50};
  instrument.blur_sigma_px = 0.1;
  instrument.pupil_sigma = 0.025;
  instrument.telecentricity_per_mm = telecentricity_per_mm;
  InstrumentView view;
  view.view = {"A1", "A", ExpRotation({38 * kDegree, 0.1, 0.2}).topRows<2>(), {0.01, -0.02}};
  view.region = {0, 0, 101, 101};
  view.viewing_direction = -view.view.RayDirection();
  view.center_in_array_mm = {0.05, 0.02, 0.3};
  instrument.views.push_back(view);
  return instrument;
}

TargetSpec SmallBoard() {
  TargetSpec plate;
  plate.columns = 3;
  plate.rows = 2;
  plate.square_mm = 0.25;
  plate.boards = {{"A", {0.02, 0.01, 0}, 0.1}};
  return plate;
}

double GrayWhere(const TargetSpec& plate, const Eigen::Vector2d& point_in_plate_mm) {
  const SubBoard& board = plate.boards[0];
  const Eigen::Vector2d in_board = Eigen::Rotation2Dd(-board.rotation_rad) *
                                   (point_in_plate_mm - board.center_in_target_mm.head<2>());
  const int column = static_cast<int>(std::floor(in_board.x() / plate.square_mm + 2));
  const int row = static_cast<int>(std::floor(in_board.y() / plate.square_mm + 1.5));
  const bool on_board = column >= 0 && column < 4 && row >= 0 && row < 3;
  return on_board && (column + row) % 2 == 0 ? 30 : 220;
}

// The grey level of a pixel from rays through a Gaussian pupil, each traced in space: through the
// pixel's point of the focus plane, with the slopes (a, b) against the chief ray, onto the plate.
double GrayByRays(const VirtualInstrument& instrument, const TargetSpec& plate,
                  const PlatePose& pose, const Eigen::Vector2d& pixel) {
  const InstrumentView& view = instrument.views[0];
  const ChiefRay chief = instrument.RayOf(view, instrument.lens.IdealFromPixel(pixel));
  const Eigen::Vector3d normal = pose.array_from_plate.col(2);
  constexpr int kSteps = 700;
  constexpr double kHalf = 5.5;  // sigmas
  double sum = 0, weights = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const Eigen::Vector2d slope(kHalf * ((2.0 * i + 1) / kSteps - 1),
                                  kHalf * ((2.0 * j + 1) / kSteps - 1));
      const Eigen::Vector3d direction =
          chief.direction_in_array +
          view.view.axes_in_array.transpose() * instrument.pupil_sigma * slope;
      const double depth =
          normal.dot(pose.origin_in_array_mm - chief.point_in_array_mm) / normal.dot(direction);
      const Eigen::Vector3d hit = chief.point_in_array_mm + depth * direction;
      const Eigen::Vector3d in_plate =
          pose.array_from_plate.transpose() * (hit - pose.origin_in_array_mm);
      const double weight = std::exp(-slope.squaredNorm() / 2);
      sum += weight * GrayWhere(plate, in_plate.head<2>());
      weights += weight;
    }
  return sum / weights;
}

// Largest difference over pixels at edges, saddles and the board's border.
void ExpectAgreement(const VirtualInstrument& instrument, double depth_mm, double tolerance_gray) {
  const TargetSpec plate = SmallBoard();
  PlatePose pose{ExpRotation({0.05, -0.04, 0.3}), {0, 0, 0}};
  const InstrumentView& view = instrument.views[0];
  pose.origin_in_array_mm = view.center_in_array_mm + depth_mm * view.viewing_direction;
  const GrayImage image = RenderPlate(instrument, plate, pose, 1);
  for (const auto& [x, y] :
       {std::pair{50, 50}, {47, 55}, {62, 48}, {35, 60}, {71, 30}, {20, 47}, {56, 72}})
    EXPECT_NEAR(image.At(x, y), GrayByRays(instrument, plate, pose, {x, y}), tolerance_gray)
        << x << ' ' << y;
}

TEST(Defocus, EqualsRaysTracedThroughThePupilOntoTheTiltedPlate) {
  // 190 grey levels of contrast; the rays' sums are coarse to about 1e-4 of it (jumps between nodes
  // 0.016 sigma apart), and the fixed blur of 1 um adds 4e-4 to a variance of 27 um squared.
  for (const double depth_mm : {-1.5, 0.9, 2.0}) {
    SCOPED_TRACE(depth_mm);
    ExpectAgreement(WideAperture(0), depth_mm, 0.15);
  }
}

TEST(Defocus, NeglectsNoMoreThanStatedWhenRaysLean) {
  // |q| |tau| kappa = 0.5 * 0.8 * 0.01 of the width: 0.4 % of it is below 0.1 % of the contrast.
  ExpectAgreement(WideAperture(0.01), 1.5, 0.15 + 0.2);
}

TEST(Defocus, DiffractionFollowsWavelengthOverAperture) {
  VirtualExperimentOptions options;
  options.numerical_aperture = 0.02;
  options.wavelength_um = 0.6;
  Session nominal;
  nominal.sensor = {100, 100, 2.2};
  nominal.lens_magnification = 0.5;
  const VirtualInstrument instrument = MakeInstrument(options, nominal);
  EXPECT_NEAR(instrument.diffraction_sigma_mm, 0.21 * 0.6e-3 / 0.02, 1e-12);
  EXPECT_EQ(instrument.pupil_sigma, 0.01);
}

}  // namespace
}  // namespace telestrain
