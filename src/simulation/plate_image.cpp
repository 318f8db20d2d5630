#include "simulation/plate_image.h"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>

#include "simulation/blurred_checkerboard.h"

namespace telestrain {
namespace {

constexpr double kHalfLength_mm = 20, kHalfWidth_mm = 4;
constexpr double kDark_gray = 30, kBright_gray = 220, kBackground_gray = 115;

// One board in one view. A telecentric view of a plane is affine, and so is its inverse:
// point = linear ideal + shift, first in the plate's and then in the board's coordinates.
struct BoardInView {
  Eigen::Matrix2d plate_from_ideal;
  Eigen::Vector2d plate_shift_mm;
  Eigen::Matrix2d board_from_plate;
  Eigen::Vector2d center_in_plate_mm;
  Eigen::Vector2d sigma_mm;  // of the blur in plate coordinates
  BlurredCheckerboard pattern;

  double Gray(const Eigen::Vector2d& ideal_mm) const;
};

// Share of a blurred stripe |x| < half, away from which it costs nothing.
double InsideStripe(double x_mm, double half_mm, double sigma_mm) {
  const double distance_sigma = (half_mm - std::abs(x_mm)) / sigma_mm;
  if (distance_sigma > 5) return 1;
  return 0.5 * std::erfc(-distance_sigma * std::numbers::sqrt2 / 2);
}

double BoardInView::Gray(const Eigen::Vector2d& ideal_mm) const {
  const Eigen::Vector2d point_mm = plate_from_ideal * ideal_mm + plate_shift_mm;
  const double on_plate = InsideStripe(point_mm.x(), kHalfLength_mm, sigma_mm.x()) *
                          InsideStripe(point_mm.y(), kHalfWidth_mm, sigma_mm.y());
  const double bright = pattern.Brightness(board_from_plate * (point_mm - center_in_plate_mm));
  const double plate_gray = kDark_gray + (kBright_gray - kDark_gray) * bright;
  return kBackground_gray + (plate_gray - kBackground_gray) * on_plate;
}

BoardInView PlaceBoard(const VirtualInstrument& instrument, const InstrumentView& view,
                       const TargetSpec& plate, const PlatePose& pose) {
  const SubBoard* board = plate.FindBoard(view.view.group);
  TELESTRAIN_CHECK(board != nullptr, "a view without a board: " + view.view.name);
  const Eigen::Matrix2d ideal_from_plate =
      view.view.axes_in_array * pose.array_from_plate.leftCols<2>();
  const Eigen::Matrix2d plate_from_ideal = ideal_from_plate.inverse();
  const double cosine = std::cos(board->rotation_rad), sine = std::sin(board->rotation_rad);
  Eigen::Matrix2d board_from_plate;
  board_from_plate << cosine, sine, -sine, cosine;
  const double blur_mm = instrument.BlurSigma_mm();
  const Eigen::Matrix2d cov_plate_mm2 =
      blur_mm * blur_mm * plate_from_ideal * plate_from_ideal.transpose();
  const Eigen::Matrix2d cov_board_mm2 =
      board_from_plate * cov_plate_mm2 * board_from_plate.transpose();
  // A board that stands off the plate by z is seen shifted along the plate.
  const Eigen::Vector3d level_mm(0, 0, board->center_in_target_mm.z());
  return {plate_from_ideal,
          -plate_from_ideal * view.view.Ideal(pose.InArray(level_mm)),
          board_from_plate,
          board->center_in_target_mm.head<2>(),
          cov_plate_mm2.diagonal().cwiseSqrt(),
          BlurredCheckerboard(plate.columns, plate.rows, plate.square_mm, cov_board_mm2)};
}

}  // namespace

GrayImage RenderPlate(const VirtualInstrument& instrument, const TargetSpec& plate,
                      const PlatePose& pose, int threads) {
  std::map<const InstrumentView*, BoardInView> boards;
  for (const InstrumentView& view : instrument.views)
    boards.emplace(&view, PlaceBoard(instrument, view, plate, pose));
  const RowShader shader = [&boards](const InstrumentView& view, const auto& ideal_mm,
                                     std::span<float> gray) {
    const BoardInView& board = boards.at(&view);
    for (std::size_t i = 0; i < gray.size(); ++i)
      gray[i] = static_cast<float>(board.Gray(ideal_mm[i]));
  };
  return RenderScene(instrument, shader, threads);
}

}  // namespace telestrain
