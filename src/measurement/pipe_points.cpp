#include "measurement/pipe_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "measurement/cylinder_fit.h"
#include "measurement/stereo_matching.h"

namespace telestrain {
namespace {

constexpr std::size_t kMinMatches = 12;  // per group
// Surface points that one view sees under more than 53 degrees do not decide about the cylinder:
// the lens blurs them on the surface otherwise than in the other view, so that subsets of 17 px
// scatter by up to three times as much there and moved the diameter by 1 to 3 um.
constexpr double kFitFacing = 0.6;
constexpr double kEdgeScatter = 3;
constexpr double kOutlierSigmas = 5;  // as the fit has it
// A point's residual against the median of its view: a subset that is partly covered or blurred
// still correlates, but is drawn towards what covers it. Contrast and shading change the residual
// of a sound subset by less than two. The floor is the misfit of the interpolation.
constexpr double kMaxResidualRatio = 3;
constexpr double kResidualFloor = 0.5 / 255;  // of the largest grey level

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

// Cosine between the surface and the view that sees it more aslant, with the pipe as located.
double Facing(const PipeGrid& grid, const PipePoint& point) {
  const StereoPair& pair = grid.pairs[static_cast<std::size_t>(point.group)];
  const Eigen::Vector3d normal = grid.pipe.Normal(point.reference_in_array_mm);
  return std::min(-normal.dot(pair.first_axis), -normal.dot(pair.second_axis));
}

// The points that the cylinder is fitted to: all of them where the views stand so far apart that
// both see most of the patch aslant.
std::vector<std::size_t> PointsThatDecide(const PipeGrid& grid) {
  std::vector<std::size_t> all(grid.points.size()), decide;
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (const std::size_t i : all)
    if (Facing(grid, grid.points[i]) >= kFitFacing) decide.push_back(i);
  return 2 * decide.size() < all.size() ? all : decide;
}

// Of the residual (noise and misfit) of the matches of one view.
double LargestResidual(const std::vector<SubsetMatch>& matches, double floor_gray) {
  std::vector<double> residuals;
  for (const SubsetMatch& match : matches)
    if (match.ok()) residuals.push_back(match.sigma_gray);
  if (residuals.empty()) return 0;
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return std::max(floor_gray, kMaxResidualRatio * *middle);
}

}  // namespace

Status PipeTracker::MatchGroup(const Session& session, int group, const GrayImage& image) {
  const StereoPair& pair = grid_.pairs[static_cast<std::size_t>(group)];
  TELESTRAIN_ASSIGN_OR_RETURN(const PipeLocation location,
                              LocatePipe(session, array_, pair, image));
  const StereoImages views{image, references_[static_cast<std::size_t>(pair.first)],
                           regions_[static_cast<std::size_t>(pair.second)]};
  const StereoMatches matches = MatchAcross(array_, pair, location.pipe, views, options_.Step_px());
  grid_.found_by_search += matches.found_by_search;
  for (const auto& [reason, count] : matches.rejected) grid_.rejected[reason] += count;
  if (matches.nodes < static_cast<int>(kMinMatches))
    return EstimationFailed("group '" + pair.group + "': only " + std::to_string(matches.nodes) +
                            " subsets fit into its field, at least " + std::to_string(kMinMatches) +
                            " are needed; make --subset-px or --step-px smaller");
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
  const std::vector<std::size_t> decides = PointsThatDecide(grid_);
  std::vector<Eigen::Vector3d> surface;
  for (const std::size_t i : decides) surface.push_back(grid_.points[i].reference_in_array_mm);
  Cylinder start = grid_.pipe;
  start.radius_mm = session.pipe.outer_diameter_mm / 2;
  TELESTRAIN_ASSIGN_OR_RETURN(const CylinderFit fit, FitCylinder(surface, start));
  grid_.pipe = fit.cylinder;
  grid_.sigma_diameter_mm = fit.sigma_diameter_mm;
  grid_.surface_rms_mm = fit.rms_mm;
  std::vector<bool> kept(grid_.points.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
    kept[i] = std::abs(fit.cylinder.Distance_mm(grid_.points[i].reference_in_array_mm)) <=
              kOutlierSigmas * kEdgeScatter * fit.rms_mm;
  for (std::size_t k = 0; k < decides.size(); ++k) kept[decides[k]] = fit.used[k];
  std::vector<PipePoint> points;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i])
      points.push_back(grid_.points[i]);
    else
      ++grid_.rejected["between the views: off the pipe's surface"];
  }
  grid_.points = std::move(points);
  if (grid_.pipe.axis.x() < 0) grid_.pipe.axis = -grid_.pipe.axis;
  return {};
}

Result<PipeTracker> PipeTracker::Start(const Session& session, const ArrayCalibration& array,
                                       const GrayImage& reference, const PipeOptions& options) {
  PipeTracker tracker;
  tracker.array_ = array;
  tracker.reference_image_ = reference;
  tracker.options_ = options;
  tracker.grid_.step_px = options.Step_px();
  TELESTRAIN_ASSIGN_OR_RETURN(tracker.grid_.pairs, StereoPairs(session, array));
  for (const NominalView& view : session.views) tracker.regions_.push_back(view.region);
  std::vector<std::optional<CorrelationReference>> references(session.views.size());
  ParallelFor(static_cast<int>(references.size()), options.threads, [&](int i) {
    const auto view = static_cast<std::size_t>(i);
    references[view].emplace(reference, tracker.regions_[view], options);
  });
  for (auto& view : references) tracker.references_.push_back(std::move(*view));
  for (std::size_t group = 0; group < tracker.grid_.pairs.size(); ++group)
    TELESTRAIN_RETURN_IF_ERROR(tracker.MatchGroup(session, static_cast<int>(group), reference));
  TELESTRAIN_RETURN_IF_ERROR(tracker.FitPipe(session));
  tracker.ListSides();
  return tracker;
}

void PipeTracker::ListSides() {
  for (std::size_t group = 0; group < grid_.pairs.size(); ++group)
    for (const int side : {0, 1}) {
      const StereoPair& pair = grid_.pairs[group];
      Side& listed = sides_.emplace_back();
      listed.group = static_cast<int>(group);
      listed.side = side;
      listed.view = side == 0 ? pair.first : pair.second;
      for (std::size_t i = 0; i < grid_.points.size(); ++i) {
        const PipePoint& point = grid_.points[i];
        if (point.group != listed.group) continue;
        listed.centers_px.push_back(side == 0 ? point.first_center_px : point.second_center_px);
        listed.owners.push_back(i);
      }
    }
}

void PipeTracker::TakeMatches(const Side& side, const std::vector<SubsetMatch>& matches,
                              std::vector<TrackedPoint>& points) const {
  // Overlapping subsets share their noise: a mean over many of them is as uncertain as if only
  // every (subset / step)^2-th counted. Enlarging the covariances by that makes sums that take the
  // points as independent come out right.
  const double overlap =
      std::pow(std::max(1.0, static_cast<double>(options_.subset_px) / options_.Step_px()), 2);
  const double largest = LargestResidual(matches, kResidualFloor * reference_image_.max_gray);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    const std::size_t owner = side.owners[k];
    TrackedPoint& point = points[owner];
    if (!matches[k].ok()) {
      point.reason = ToText(matches[k].status);
      continue;
    }
    if (matches[k].sigma_gray > largest) {
      point.reason = "covered, blurred or changed";
      continue;
    }
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    if (side.side == 1)
      offset = grid_.points[owner].second_pixel - side.centers_px[k].cast<double>();
    ViewMeasurement& measured = point.measured[static_cast<std::size_t>(side.side)];
    measured = MeasureAt(side.view, side.centers_px[k], offset, matches[k]);
    measured.covariance_px2 *= overlap;
    point.zncc = side.side == 0 ? matches[k].zncc : std::min(point.zncc, matches[k].zncc);
  }
}

TrackedState PipeTracker::Track(const GrayImage& image, const std::vector<ViewMotion>& from) const {
  TrackedState state;
  state.points.resize(grid_.points.size());
  state.motions.resize(regions_.size());
  std::vector<std::optional<PreparedImage>> prepared(sides_.size());
  std::vector<ViewMotion> motions(sides_.size());
  ParallelFor(static_cast<int>(sides_.size()), options_.threads, [&](int i) {
    const Side& side = sides_[static_cast<std::size_t>(i)];
    const auto view = static_cast<std::size_t>(side.view);
    auto& of_view = prepared[static_cast<std::size_t>(i)];
    of_view.emplace(image, regions_[view], options_);
    motions[static_cast<std::size_t>(i)] =
        FindMotion({references_[view], *of_view, reference_image_, image}, side.centers_px,
                   view < from.size() ? from[view] : ViewMotion{})
            .motion;
  });
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& side = sides_[i];
    const auto view = static_cast<std::size_t>(side.view);
    const auto matches = CorrelatePoints(references_[view], side.centers_px, *prepared[i],
                                         StartsOf(regions_[view], side.centers_px, motions[i]));
    TakeMatches(side, matches, state.points);
    state.motions[view] = FitMotion(regions_[view], side.centers_px, matches, motions[i]);
  }
  return state;
}

}  // namespace telestrain
