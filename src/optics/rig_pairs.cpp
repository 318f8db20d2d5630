#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "optics/rig_parts.h"

namespace telestrain {
namespace {

constexpr int kArcSteps = 3600;  // over half the pipe's circumference

// A plane that faces a group: x along the pipe as far as it goes, y across.
struct FacingPlane {
  Eigen::Vector3d center_mm, along, across, facing;

  FacingPlane(const Eigen::Vector3d& center, const Eigen::Vector3d& towards_cameras)
      : center_mm(center), facing(towards_cameras.normalized()) {
    along = Eigen::Vector3d::UnitX() - facing.x() * facing;
    if (along.norm() < 1e-6) along = facing.unitOrthogonal();
    along.normalize();
    across = facing.cross(along);
  }
  Eigen::Vector3d InArray(const Eigen::Vector2d& point_mm) const {
    return center_mm + point_mm.x() * along + point_mm.y() * across;
  }
};

// Where the rays of the field's corners meet the plane.
ConvexOutline FootprintOn(const FacingPlane& plane, const ViewDesign& view) {
  std::vector<Eigen::Vector2d> points;
  for (const TracedRay& ray : view.corner_rays) {
    const double along_mm =
        plane.facing.dot(plane.center_mm - ray.end_mm) / plane.facing.dot(ray.direction);
    const Eigen::Vector3d offset = ray.end_mm + along_mm * ray.direction - plane.center_mm;
    points.emplace_back(plane.along.dot(offset), plane.across.dot(offset));
  }
  return HullOf(points);
}

// The point midway between two lines where they are nearest.
Eigen::Vector3d MeetingPoint(const TracedRay& a, const TracedRay& b) {
  const Eigen::Vector3d between = b.end_mm - a.end_mm;
  const double c = a.direction.dot(b.direction), sine2 = std::max(1 - c * c, 1e-12);
  const double s = (a.direction.dot(between) - c * b.direction.dot(between)) / sine2;
  const double t = (c * a.direction.dot(between) - b.direction.dot(between)) / sine2;
  return 0.5 * (a.end_mm + s * a.direction + b.end_mm + t * b.direction);
}

double Depth_mm(const ViewDesign& view, const Eigen::Vector3d& point_mm) {
  return view.middle_ray.direction.dot(point_mm - view.middle_ray.end_mm);
}

double DepthSpread_mm(const ViewDesign& view, const FacingPlane& plane,
                      const ConvexOutline& patch) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const Eigen::Vector2d& corner : patch) {
    const double depth_mm = Depth_mm(view, plane.InArray(corner));
    low = std::min(low, depth_mm);
    high = std::max(high, depth_mm);
  }
  return patch.empty() ? 0 : high - low;
}

bool Sees(const OpticalRig& rig, const OpticalPath& path, const Eigen::Vector3d& point_mm,
          const Eigen::Vector3d& surface_normal) {
  const PhysicalCamera camera = VirtualCamera(rig, path);
  const Eigen::Vector3d offset = point_mm - camera.position_mm;
  return surface_normal.dot(camera.axis) < 0 &&
         path.field_mm.contains(
             Eigen::Vector2d(camera.image_x.dot(offset), camera.image_y.dot(offset)));
}

// Walks over the half of the pipe that faces the pair, in the section through the pair's centre.
void FindArcs(const OpticalRig& rig, const RigDesign& design, std::size_t first, std::size_t second,
              PairDesign& pair) {
  const FacingPlane plane(pair.center_in_array_mm, pair.facing);
  const double radius_mm = 0.5 * *rig.pipe_diameter_mm;
  const double step_mm = std::numbers::pi * radius_mm / kArcSteps;
  int seen = 0, sharp = 0;
  for (int i = 0; i < kArcSteps; ++i) {
    const double angle = std::numbers::pi * ((i + 0.5) / kArcSteps - 0.5);
    const Eigen::Vector3d normal = std::cos(angle) * plane.facing + std::sin(angle) * plane.across;
    const Eigen::Vector3d point_mm = plane.center_mm + radius_mm * (normal - plane.facing);
    if (!Sees(rig, rig.paths[first], point_mm, normal) ||
        !Sees(rig, rig.paths[second], point_mm, normal))
      continue;
    ++seen;
    const double deepest_mm = std::max(std::abs(Depth_mm(design.views[first], point_mm)),
                                       std::abs(Depth_mm(design.views[second], point_mm)));
    sharp += deepest_mm <= 0.5 * rig.depth_of_field_mm ? 1 : 0;
  }
  pair.seen_arc_mm = seen * step_mm;
  pair.sharp_arc_mm = sharp * step_mm;
}

Eigen::Vector2d SizeOf(const ConvexOutline& outline) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : outline) box.extend(corner);
  return outline.empty() ? Eigen::Vector2d::Zero() : Eigen::Vector2d(box.sizes());
}

PairDesign DesignPair(const OpticalRig& rig, RigDesign& design, std::size_t i, std::size_t j) {
  ViewDesign &first = design.views[i], &second = design.views[j];
  PairDesign pair;
  pair.group = first.group;
  pair.first = first.name;
  pair.second = second.name;
  const Eigen::Vector3d &a = first.middle_ray.direction, &b = second.middle_ray.direction;
  pair.stereo_angle_rad = std::atan2(a.cross(b).norm(), a.dot(b));
  pair.center_in_array_mm = MeetingPoint(first.middle_ray, second.middle_ray);
  const FacingPlane plane(pair.center_in_array_mm, -(a + b));
  pair.facing = plane.facing;
  const ConvexOutline of_first = FootprintOn(plane, first), of_second = FootprintOn(plane, second);
  const ConvexOutline common = Intersection(of_first, of_second);
  pair.overlap_percent =
      100 * AreaOf_mm2(common) / std::min(AreaOf_mm2(of_first), AreaOf_mm2(of_second));
  pair.common_mm = SizeOf(common);
  pair.depth_spread_mm =
      std::max(DepthSpread_mm(first, plane, common), DepthSpread_mm(second, plane, common));
  if (rig.pipe_diameter_mm) FindArcs(rig, design, i, j, pair);
  return pair;
}

// The plane that a view's footprint lies in: of its first pair, else facing the view itself.
FacingPlane PlaneOf(const RigDesign& design, const ViewDesign& view) {
  for (const PairDesign& pair : design.pairs)
    if (pair.first == view.name || pair.second == view.name)
      return {pair.center_in_array_mm, pair.facing};
  return {view.middle_ray.end_mm, -view.middle_ray.direction};
}

// Where a group's footprints begin and end along the array's x.
struct Interval {
  std::string group;
  double low_mm = std::numeric_limits<double>::max();
  double high_mm = std::numeric_limits<double>::lowest();
};

std::vector<Interval> IntervalsAlongPipe(RigDesign& design) {
  std::vector<Interval> intervals;
  for (ViewDesign& view : design.views) {
    const FacingPlane plane = PlaneOf(design, view);
    view.footprint_mm = FootprintOn(plane, view);
    auto at = std::find_if(intervals.begin(), intervals.end(),
                           [&](const Interval& i) { return i.group == view.group; });
    if (at == intervals.end()) at = intervals.insert(at, Interval{view.group});
    for (const Eigen::Vector2d& corner : view.footprint_mm) {
      const double x_mm = plane.InArray(corner).x();
      at->low_mm = std::min(at->low_mm, x_mm);
      at->high_mm = std::max(at->high_mm, x_mm);
    }
  }
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& a, const Interval& b) { return a.low_mm < b.low_mm; });
  return intervals;
}

}  // namespace

void DesignPairs(const OpticalRig& rig, RigDesign& design) {
  for (std::size_t i = 0; i < design.views.size(); ++i)
    for (std::size_t j = i + 1; j < design.views.size(); ++j)
      if (design.views[i].group == design.views[j].group)
        design.pairs.push_back(DesignPair(rig, design, i, j));
  const std::vector<Interval> intervals = IntervalsAlongPipe(design);
  double highest_mm = intervals.front().high_mm;
  for (std::size_t i = 1; i < intervals.size(); ++i) {
    const double gap_mm = intervals[i].low_mm - highest_mm;
    design.field_gap_mm = std::min(design.field_gap_mm.value_or(gap_mm), gap_mm);
    highest_mm = std::max(highest_mm, intervals[i].high_mm);
  }
  design.total_field_mm = highest_mm - intervals.front().low_mm;
  if (!design.pairs.empty() && design.pairs.front().group != design.pairs.back().group)
    design.base_length_mm =
        (design.pairs.back().center_in_array_mm - design.pairs.front().center_in_array_mm).norm();
  const auto [shortest, longest] = std::minmax_element(
      design.views.begin(), design.views.end(),
      [](const auto& a, const auto& b) { return a.focus_path_mm < b.focus_path_mm; });
  design.path_spread_mm = longest->focus_path_mm - shortest->focus_path_mm;
}

}  // namespace telestrain
