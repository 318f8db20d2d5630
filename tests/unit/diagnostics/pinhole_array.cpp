#include "unit/diagnostics/pinhole_array.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/calibrate.h"
#include "geometry/rotation.h"

namespace telestrain::testing_support {
namespace {

Eigen::Vector3d RandomVector(Random& random, double reach) {
  const double x = random.Uniform(-reach, reach), y = random.Uniform(-reach, reach);
  return {x, y, random.Uniform(-reach, reach)};
}

}  // namespace

PinholeCalibration PinholeCase::MustCalibrate(const PinholeOptions& options) const {
  auto found = CalibratePinhole(array.session, data, telecentric, options);
  EXPECT_TRUE(found.ok()) << (found.ok() ? "" : found.error().message);
  return std::move(found).value();
}

PinholeCase MakeCase(const SyntheticOptions& options) {
  PinholeCase made;
  made.array = MakeSyntheticArray(options);
  const Calibration calibration = Calibrate(made.array.session, made.array.boards).value();
  made.data = calibration.data;
  made.telecentric = calibration.bundle.state;
  made.telecentric_rms_px = calibration.all.rms_px;
  return made;
}

void SeeWith(const std::vector<PinholeView>& views, PinholeCase& made) {
  for (BoardData& board : made.data.boards) {
    const TargetPose& pose = made.telecentric.poses[static_cast<std::size_t>(board.image)];
    const PinholeView& view = views[static_cast<std::size_t>(board.view)];
    for (Eigen::Index i = 0; i < board.Count(); ++i)
      board.pixels.col(i) =
          view.Project(pose.array_from_target * board.corners_in_target_mm.col(i) +
                       pose.origin_in_array_mm)
              .value();
  }
}

void DisturbStart(PinholeCase& made) {
  constexpr double kTurn_rad = 0.005, kShift_mm = 0.1;
  Random random(5);
  for (TelecentricView& view : made.telecentric.array.views) {
    view.axes_in_array =
        (ExpRotation(RandomVector(random, kTurn_rad)) * view.Rotation()).topRows<2>();
    view.offset_mm += RandomVector(random, kShift_mm).head<2>();
  }
  for (TargetPose& pose : made.telecentric.poses) {
    pose.array_from_target = ExpRotation(RandomVector(random, kTurn_rad)) * pose.array_from_target;
    pose.origin_in_array_mm += RandomVector(random, kShift_mm);
  }
}

std::vector<CrossObservation> MakeRulers(SyntheticArray& array, int count) {
  Random random(77);
  std::vector<CrossObservation> crosses;
  for (int r = 0; r < count; ++r) {
    const std::string image = "ruler_" + std::to_string(r) + ".png";
    array.session.ruler_images.push_back(image);
    const Eigen::Vector3d middle = RandomVector(random, 0.8);
    const Eigen::Vector3d along =
        (Eigen::Vector3d::UnitX() + RandomVector(random, 0.02)).normalized();
    for (std::size_t v = 0; v < array.views.size(); ++v) {
      const double reach_mm =
          (array.views[v].group == "A" ? -0.5 : 0.5) * array.session.ruler.length_mm;
      crosses.push_back({image, array.views[v].name,
                         Observe(array, v, middle + reach_mm * along, 0, random), ""});
    }
  }
  return crosses;
}

double RmsError_um(const std::vector<PinholeRulerLength>& lengths) {
  double squares = 0;
  for (const PinholeRulerLength& length : lengths) {
    EXPECT_EQ(length.rejected_because, "");
    squares += length.error_um * length.error_um;
  }
  return std::sqrt(squares / static_cast<double>(lengths.size()));
}

}  // namespace telestrain::testing_support
