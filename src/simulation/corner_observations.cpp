#include "simulation/corner_observations.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "simulation/random_stream.h"

namespace telestrain {
namespace {

// A corner at the very border has no pixels around it to be found in.
constexpr double kBorder_px = 8;

bool IsInside(const PixelRegion& region, const Eigen::Vector2d& pixel) {
  return pixel.x() >= region.x + kBorder_px && pixel.y() >= region.y + kBorder_px &&
         pixel.x() <= region.x + region.width - 1 - kBorder_px &&
         pixel.y() <= region.y + region.height - 1 - kBorder_px;
}

// Determinant of the blur's covariance: its fourth root is the mean width of an edge, so the
// square root of a width is its eighth root.
double BlurDeterminant_mm4(const ViewBlur& blur, double depth_mm) {
  return blur.CovAt_mm2(depth_mm).determinant();
}

// The corners of one plate in one view.
std::vector<std::optional<ImagePoint>> ObservePlate(const VirtualInstrument& instrument,
                                                    const InstrumentView& view,
                                                    const TargetSpec& plate, const PlatePose& pose,
                                                    const CornerNoise& noise) {
  const SubBoard* board = plate.FindBoard(view.view.group);
  TELESTRAIN_CHECK(board != nullptr, "a view without a board: " + view.view.name);
  const Eigen::Matrix3Xd corners_mm = plate.CornersInTarget(*board);
  const Eigen::Matrix2d covariance_px2 =
      noise.sigma_px * noise.sigma_px * Eigen::Matrix2d::Identity();
  const ViewBlur blur = instrument.BlurOf(view);
  std::vector<std::optional<ImagePoint>> points;
  for (Eigen::Index i = 0; i < corners_mm.cols(); ++i) {
    const Eigen::Vector3d point_mm = pose.InArray(corners_mm.col(i));
    const Eigen::Vector2d pixel = instrument.Project(view, point_mm);
    const auto normal = NormalPair(noise.key, static_cast<std::uint64_t>(i));
    points.emplace_back();
    if (!IsInside(view.region, pixel)) continue;
    const double widening =
        BlurDeterminant_mm4(blur, view.BeyondFocus_mm(point_mm)) / BlurDeterminant_mm4(blur, 0);
    const double sigma_px = noise.sigma_px * std::pow(widening, 0.125);
    points.back() =
        ImagePoint{pixel + sigma_px * Eigen::Vector2d(normal[0], normal[1]), covariance_px2};
  }
  return points;
}

CornerNoise NoiseOf(const CornerNoise& noise, std::size_t image, std::size_t view) {
  return {noise.sigma_px, CombineKeys(CombineKeys(noise.key, image), view)};
}

}  // namespace

std::vector<BoardObservation> ObserveBoards(const ExperimentTruth& truth, const CornerNoise& noise,
                                            int min_corners) {
  std::vector<BoardObservation> boards;
  for (std::size_t i = 0; i < truth.calibration.size(); ++i)
    for (std::size_t v = 0; v < truth.instrument.views.size(); ++v) {
      const InstrumentView& view = truth.instrument.views[v];
      BoardObservation board{truth.calibration[i].image, view.view.name, {}, {}};
      board.corners = ObservePlate(truth.instrument, view, truth.target, truth.calibration[i].plate,
                                   NoiseOf(noise, i, v));
      const auto seen = std::count_if(board.corners.begin(), board.corners.end(),
                                      [](const auto& corner) { return corner.has_value(); });
      if (seen < min_corners) {
        board.corners.clear();
        board.rejected_because = "only " + std::to_string(seen) + " corners are seen, " +
                                 std::to_string(min_corners) + " wanted";
      }
      boards.push_back(std::move(board));
    }
  return boards;
}

std::vector<CrossObservation> ObserveCrosses(const ExperimentTruth& truth,
                                             const CornerNoise& noise) {
  std::vector<CrossObservation> crosses;
  for (std::size_t i = 0; i < truth.rulers.size(); ++i)
    for (std::size_t v = 0; v < truth.instrument.views.size(); ++v) {
      const InstrumentView& view = truth.instrument.views[v];
      CrossObservation cross{truth.rulers[i].image, view.view.name, {}, {}};
      cross.center = ObservePlate(truth.instrument, view, truth.ruler, truth.rulers[i].plate,
                                  NoiseOf(noise, i, v))
                         .front();
      if (!cross.center) cross.rejected_because = "the cross lies outside the view";
      crosses.push_back(std::move(cross));
    }
  return crosses;
}

}  // namespace telestrain
