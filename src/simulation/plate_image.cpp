#include "simulation/plate_image.h"

#include <Eigen/LU>
#include <cmath>
#include <map>

#include "simulation/blurred_checkerboard.h"
#include "simulation/normal_share.h"
#include "simulation/scene_image.h"

namespace telestrain {
namespace {

constexpr double kHalfSize_mm[] = {20, 4};
constexpr double kDark_gray = 30, kBright_gray = 220, kBackground_gray = 115;

// Share of the plate between its two edges across one axis, away from which it costs nothing.
double InsideStripe(const PlaneBlur& blur, int axis, double coordinate_mm, double depth_mm) {
  const double inside_mm = kHalfSize_mm[axis] - std::abs(coordinate_mm);
  if (inside_mm > blur.Reach_mm(axis, depth_mm)) return 1;
  const double ahead_mm = std::copysign(kHalfSize_mm[axis], coordinate_mm) - coordinate_mm;
  return NormalShare(inside_mm / std::sqrt(blur.Variance_mm2(axis, depth_mm, ahead_mm)));
}

// A plate in one view, with the board that belongs to the view.
//
// The pixel at the image-plane coordinates x meets the plate at q = s x, where the depth beyond
// focus is z = depth + slope.q; s = 1 + kappa z (residual telecentricity kappa) gives
//   s = (1 + kappa depth) / (1 - kappa slope.x).
// Plate coordinates are affine in q, board coordinates in plate coordinates.
struct PlateInView {
  double telecentricity_per_mm;
  double depth_mm;        // of q = 0
  Eigen::Vector2d slope;  // dz/dq
  Eigen::Matrix2d plate_from_q;
  Eigen::Vector2d plate_shift_mm;
  Eigen::Matrix2d board_from_plate;
  Eigen::Vector2d center_in_plate_mm;
  double square_gray, plate_gray;
  PlaneBlur plate_blur;
  BlurredCheckerboard pattern;

  double Gray(const Eigen::Vector2d& ideal_mm) const;
};

double PlateInView::Gray(const Eigen::Vector2d& ideal_mm) const {
  const double kappa = telecentricity_per_mm;
  const double scale = (1 + kappa * depth_mm) / (1 - kappa * slope.dot(ideal_mm));
  const Eigen::Vector2d q_mm = scale * ideal_mm;
  const double z_mm = depth_mm + slope.dot(q_mm);
  const Eigen::Vector2d point_mm = plate_from_q * q_mm + plate_shift_mm;
  const double on_plate = InsideStripe(plate_blur, 0, point_mm.x(), z_mm) *
                          InsideStripe(plate_blur, 1, point_mm.y(), z_mm);
  const double share = pattern.Brightness(board_from_plate * (point_mm - center_in_plate_mm), z_mm);
  const double gray = square_gray + (plate_gray - square_gray) * share;
  return kBackground_gray + (gray - kBackground_gray) * on_plate;
}

PlateInView PlacePlate(const VirtualInstrument& instrument, const InstrumentView& view,
                       const TargetSpec& plate, const PlatePose& pose, PlateTone tone) {
  const SubBoard* board = plate.FindBoard(view.view.group);
  TELESTRAIN_CHECK(board != nullptr, "a view without a board: " + view.view.name);
  const auto plate_axes = pose.array_from_plate.leftCols<2>();
  const Eigen::Matrix2d plate_from_q = (view.view.axes_in_array * plate_axes).inverse();
  const Eigen::Vector2d slope =
      (view.viewing_direction.transpose() * plate_axes * plate_from_q).transpose();
  // A board that stands off the plate by z is seen shifted along the plate.
  const Eigen::Vector3d level_mm =
      pose.InArray(Eigen::Vector3d(0, 0, board->center_in_target_mm.z()));
  const Eigen::Vector2d level_q_mm = view.view.Ideal(level_mm);
  const double cosine = std::cos(board->rotation_rad), sine = std::sin(board->rotation_rad);
  Eigen::Matrix2d board_from_plate;
  board_from_plate << cosine, sine, -sine, cosine;
  const ViewBlur blur = instrument.BlurOf(view);
  const bool dark_squares = tone == PlateTone::kDarkSquares;
  return {instrument.telecentricity_per_mm,
          view.BeyondFocus_mm(level_mm) - slope.dot(level_q_mm),
          slope,
          plate_from_q,
          -plate_from_q * level_q_mm,
          board_from_plate,
          board->center_in_target_mm.head<2>(),
          dark_squares ? kDark_gray : kBright_gray,
          dark_squares ? kBright_gray : kDark_gray,
          PlaneBlur(blur, plate_from_q, slope),
          BlurredCheckerboard(plate.columns, plate.rows, plate.square_mm,
                              PlaneBlur(blur, board_from_plate * plate_from_q, slope))};
}

}  // namespace

GrayImage RenderPlate(const VirtualInstrument& instrument, const TargetSpec& plate,
                      const PlatePose& pose, int threads, PlateTone tone) {
  std::map<const InstrumentView*, PlateInView> plates;
  for (const InstrumentView& view : instrument.views)
    plates.emplace(&view, PlacePlate(instrument, view, plate, pose, tone));
  const RowShader shader = [&plates](const InstrumentView& view, const auto& ideal_mm,
                                     std::span<float> gray) {
    const PlateInView& in_view = plates.at(&view);
    for (std::size_t i = 0; i < gray.size(); ++i)
      gray[i] = static_cast<float>(in_view.Gray(ideal_mm[i]));
  };
  return RenderScene(instrument, shader, threads);
}

}  // namespace telestrain
