#include "measurement/pipe_points.h"

#include <algorithm>

#include "measurement/cylinder_fit.h"
#include "measurement/stereo_matching.h"

namespace telestrain {
namespace {

constexpr double kMaxShiftShare = 0.08;  // of the region's width, searched between states
constexpr std::size_t kMinMatches = 12;  // per group

// Position of the material point at sub-pixel offset `offset` from the subset's centre.
ViewMeasurement MeasureAt(int view, const Eigen::Vector2i& center, const Eigen::Vector2d& offset,
                          const SubsetMatch& match) {
  Eigen::Matrix<double, 2, 6> jacobian = Eigen::Matrix<double, 2, 6>::Zero();
  jacobian(0, 0) = jacobian(1, 1) = 1;
  jacobian.block<1, 2>(0, 2) = offset.transpose();
  jacobian.block<1, 2>(1, 4) = offset.transpose();
  ViewMeasurement measured;
  measured.view = view;
  measured.pixel =
      center.cast<double>() + offset + match.shape.displacement_px + match.shape.gradient * offset;
  measured.covariance_px2 = jacobian * match.covariance * jacobian.transpose();
  return measured;
}

}  // namespace

Status PipeTracker::MatchGroup(const Session& session, int group, const GrayImage& image) {
  const StereoPair& pair = grid_.pairs[static_cast<std::size_t>(group)];
  TELESTRAIN_ASSIGN_OR_RETURN(const PipeLocation location,
                              LocatePipe(session, array_, pair, image));
  const StereoMatches matches = MatchAcross(array_, pair, location.pipe, image,
                                            references_[static_cast<std::size_t>(pair.first)],
                                            regions_[static_cast<std::size_t>(pair.second)]);
  for (const auto& [reason, count] : matches.rejected) grid_.rejected[reason] += count;
  if (matches.found.size() < kMinMatches)
    return EstimationFailed(
        "group '" + pair.group + "': only " + std::to_string(matches.found.size()) + " of " +
        std::to_string(matches.nodes) + " subsets match between its two views, at least " +
        std::to_string(kMinMatches) + " are needed; look at the speckle pattern and the focus");
  for (const StereoMatch& match : matches.found) {
    PipePoint point;
    point.group = group;
    point.column = match.column;
    point.row = match.row;
    point.first_center_px = match.first_center_px;
    point.second_pixel = match.second_pixel;
    point.second_center_px = match.second_pixel.array().round().cast<int>();
    point.reference_in_array_mm =
        Triangulate(array_,
                    {{pair.first, match.first_center_px.cast<double>(), Eigen::Matrix2d::Zero()},
                     {pair.second, match.second_pixel, match.covariance_px2}})
            .in_array_mm;
    grid_.points.push_back(point);
  }
  if (group == 0) grid_.pipe = location.pipe;
  return {};
}

Status PipeTracker::FitPipe(const Session& session) {
  std::vector<Eigen::Vector3d> surface;
  for (const PipePoint& point : grid_.points) surface.push_back(point.reference_in_array_mm);
  Cylinder start = grid_.pipe;
  start.radius_mm = session.pipe.outer_diameter_mm / 2;
  TELESTRAIN_ASSIGN_OR_RETURN(const CylinderFit fit, FitCylinder(surface, start));
  grid_.pipe = fit.cylinder;
  grid_.sigma_diameter_mm = fit.sigma_diameter_mm;
  grid_.surface_rms_mm = fit.rms_mm;
  std::vector<PipePoint> kept;
  for (std::size_t i = 0; i < grid_.points.size(); ++i) {
    if (fit.used[i])
      kept.push_back(grid_.points[i]);
    else
      ++grid_.rejected["between the views: off the pipe's surface"];
  }
  grid_.points = std::move(kept);
  if (grid_.pipe.axis.x() < 0) grid_.pipe.axis = -grid_.pipe.axis;
  return {};
}

Result<PipeTracker> PipeTracker::Start(const Session& session, const ArrayCalibration& array,
                                       const GrayImage& reference,
                                       const CorrelationOptions& options) {
  PipeTracker tracker;
  tracker.array_ = array;
  tracker.reference_image_ = reference;
  tracker.options_ = options;
  tracker.grid_.step_px = options.subset_px;
  TELESTRAIN_ASSIGN_OR_RETURN(tracker.grid_.pairs, StereoPairs(session, array));
  for (const NominalView& view : session.views) {
    tracker.regions_.push_back(view.region);
    tracker.references_.emplace_back(reference, view.region, options);
  }
  for (std::size_t group = 0; group < tracker.grid_.pairs.size(); ++group)
    TELESTRAIN_RETURN_IF_ERROR(tracker.MatchGroup(session, static_cast<int>(group), reference));
  TELESTRAIN_RETURN_IF_ERROR(tracker.FitPipe(session));
  return tracker;
}

// Follows the points of one group in one of its views: side 0 is the first, 1 the second.
void PipeTracker::TrackView(const GrayImage& image, int group, int side,
                            std::vector<TrackedPoint>& tracked) const {
  const StereoPair& pair = grid_.pairs[static_cast<std::size_t>(group)];
  const int view = side == 0 ? pair.first : pair.second;
  const PixelRegion& region = regions_[static_cast<std::size_t>(view)];
  std::vector<Eigen::Vector2i> centers;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < grid_.points.size(); ++i) {
    const PipePoint& point = grid_.points[i];
    if (point.group != group) continue;
    centers.push_back(side == 0 ? point.first_center_px : point.second_center_px);
    owner.push_back(i);
  }
  const ShiftSearch shift =
      SearchShift(reference_image_, image, region, static_cast<int>(kMaxShiftShare * region.width));
  const ShapeFunction start{shift.shift_px, Eigen::Matrix2d::Zero()};
  const std::vector<SubsetMatch> matches =
      CorrelatePoints(references_[static_cast<std::size_t>(view)], centers,
                      PreparedImage(image, region, options_), {start});
  for (std::size_t k = 0; k < owner.size(); ++k) {
    TrackedPoint& point = tracked[owner[k]];
    if (!matches[k].ok()) {
      point.reason = ToText(matches[k].status);
      continue;
    }
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    if (side == 1) offset = grid_.points[owner[k]].second_pixel - centers[k].cast<double>();
    point.measured[static_cast<std::size_t>(side)] =
        MeasureAt(view, centers[k], offset, matches[k]);
    point.zncc = side == 0 ? matches[k].zncc : std::min(point.zncc, matches[k].zncc);
  }
}

std::vector<TrackedPoint> PipeTracker::Track(const GrayImage& image) const {
  std::vector<TrackedPoint> tracked(grid_.points.size());
  for (std::size_t group = 0; group < grid_.pairs.size(); ++group)
    for (const int side : {0, 1}) TrackView(image, static_cast<int>(group), side, tracked);
  return tracked;
}

}  // namespace telestrain
