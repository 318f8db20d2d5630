#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "optics/rig_parts.h"

namespace telestrain {
namespace {

constexpr int kRings = 4;      // of equal area, a ray in the middle of each
constexpr int kAzimuths = 16;  // per ring

std::string PlateName(const OpticalPath& path, std::size_t mirror) {
  return path.name + " M" + std::to_string(mirror + 1);
}

// Points on every mirror: of the four corners' chief rays, and of the rims of their cones.
struct CornerHits {
  std::vector<std::vector<Eigen::Vector3d>> chief_mm, rim_mm;  // per mirror
};

Result<CornerHits> HitsOfCorners(const OpticalRig& rig, const OpticalPath& path,
                                 const ViewDesign& view, double numerical_aperture) {
  CornerHits hits;
  hits.chief_mm.resize(path.mirrors.size());
  hits.rim_mm.resize(path.mirrors.size());
  const PhysicalCamera camera = VirtualCamera(rig, path);
  const std::vector<Mirror> backwards(path.mirrors.rbegin(), path.mirrors.rend());
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const TracedRay& chief = view.corner_rays[corner];
    for (std::size_t i = 0; i < path.mirrors.size(); ++i)
      hits.chief_mm[i].push_back(chief.hits[i].point_mm);
    for (const ApertureRay& ray : ApertureRays(camera, numerical_aperture)) {
      TELESTRAIN_ASSIGN_OR_RETURN(const auto back,
                                  HitMirrors(chief.end_mm, ray.direction, backwards));
      for (std::size_t i = 0; i < back.size(); ++i)
        hits.rim_mm[back.size() - 1 - i].push_back(back[i].point_mm);
    }
  }
  return hits;
}

Eigen::AlignedBox2d BoxOf(const MirrorPlate& plate, const std::vector<Eigen::Vector3d>& points_mm) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& point : points_mm) box.extend(plate.InPlate(point));
  return box;
}

// Axes along an edge of the chief rays' footprint, the one with the smaller rectangle; the longer
// side of the rectangle is x.
MirrorPlate PlateAxes(const Mirror& mirror, const std::vector<Eigen::Vector3d>& chief_mm) {
  MirrorPlate best;
  double smallest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < 2; ++i) {
    MirrorPlate plate;
    plate.origin_mm = 0.25 * (chief_mm[0] + chief_mm[1] + chief_mm[2] + chief_mm[3]);
    plate.axis_x = (chief_mm[i + 1] - chief_mm[i]).normalized();
    plate.axis_y = mirror.normal.cross(plate.axis_x).normalized();
    const Eigen::Vector2d size_mm = BoxOf(plate, chief_mm).sizes();
    if (size_mm.x() < size_mm.y()) {
      plate.axis_x = plate.axis_y;
      plate.axis_y = mirror.normal.cross(plate.axis_x).normalized();
    }
    // Rounding must not decide between equal rectangles.
    if (size_mm.prod() > (1 - 1e-9) * smallest) continue;
    smallest = size_mm.prod();
    best = plate;
  }
  return best;
}

MirrorDesign DesignMirror(const Mirror& mirror, const CornerHits& hits, std::size_t index,
                          const DesignOptions& options) {
  MirrorDesign design;
  design.plate = PlateAxes(mirror, hits.chief_mm[index]);
  design.plate.mirror = static_cast<int>(index);
  const Eigen::AlignedBox2d chief = BoxOf(design.plate, hits.chief_mm[index]);
  Eigen::AlignedBox2d needed = chief;
  needed.extend(BoxOf(design.plate, hits.rim_mm[index]));
  design.chief_size_mm = chief.sizes();
  design.needed_size_mm = needed.sizes();
  design.cone_radius_mm = 0.5 * (design.needed_size_mm - design.chief_size_mm);
  Eigen::Vector2d half = 0.5 * needed.sizes();
  if (index < options.mirror_sizes_mm.size()) half = 0.5 * options.mirror_sizes_mm[index];
  half.array() += options.mirror_margin_mm;
  if ((half.array() <= 0).any()) return design;  // no mirror is left
  design.plate.outline_mm = RectangleOutline(needed.center() - half, needed.center() + half);
  return design;
}

Status TraceView(const OpticalRig& rig, const OpticalPath& path, ViewDesign& view) {
  const auto trace = [&](const Eigen::Vector2d& ideal_mm) {
    return TraceRay(rig.camera, path.mirrors, ideal_mm, view.focus_path_mm);
  };
  TELESTRAIN_ASSIGN_OR_RETURN(view.middle_ray, trace(path.field_mm.center()));
  for (const Eigen::Vector2d& corner : CornersOf(path.field_mm)) {
    TELESTRAIN_ASSIGN_OR_RETURN(view.corner_rays.emplace_back(), trace(corner));
  }
  return {};
}

Error InView(const std::string& name, const Error& error) {
  return {error.kind, "view '" + name + "': " + error.message};
}

}  // namespace

std::array<Eigen::Vector2d, 4> CornersOf(const Eigen::AlignedBox2d& field_mm) {
  const Eigen::Vector2d low = field_mm.min(), high = field_mm.max();
  return {low, Eigen::Vector2d(high.x(), low.y()), high, Eigen::Vector2d(low.x(), high.y())};
}

Eigen::Vector3d ObjectPoint(const PhysicalCamera& virtual_camera, const Eigen::Vector2d& ideal_mm,
                            double focus_path_mm) {
  return virtual_camera.position_mm + ideal_mm.x() * virtual_camera.image_x +
         ideal_mm.y() * virtual_camera.image_y + focus_path_mm * virtual_camera.axis;
}

std::vector<ApertureRay> ApertureRays(const PhysicalCamera& virtual_camera,
                                      double numerical_aperture) {
  std::vector<ApertureRay> rays;
  const auto add_ring = [&](double share, double weight) {
    const double sine = share * numerical_aperture;
    for (int i = 0; i < kAzimuths; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / kAzimuths;
      const Eigen::Vector3d aside =
          std::cos(angle) * virtual_camera.image_x + std::sin(angle) * virtual_camera.image_y;
      rays.push_back({sine * aside - std::sqrt(1 - sine * sine) * virtual_camera.axis, weight});
    }
  };
  for (int ring = 0; ring < kRings; ++ring)
    add_ring(std::sqrt((ring + 0.5) / kRings), 1.0 / (kRings * kAzimuths));
  add_ring(1, 0);
  return rays;
}

Result<ViewDesign> DesignView(const OpticalRig& rig, std::size_t index,
                              const DesignOptions& options, double numerical_aperture) {
  const OpticalPath& path = rig.paths[index];
  ViewDesign view;
  view.name = path.name;
  view.group = path.group;
  view.mirrors = static_cast<int>(path.mirrors.size());
  view.handedness = Handedness(VirtualCamera(rig, path));
  view.focus_path_mm = FocusPath_mm(rig, path);
  view.field_mm = path.field_mm.sizes();
  if (const Status traced = TraceView(rig, path, view); !traced)
    return InView(path.name, traced.error());
  const double to_first_mm = path.mirrors.empty() ? 0 : view.middle_ray.hits.front().path_mm;
  view.first_mirror_path_mm = view.focus_path_mm - to_first_mm;
  const auto hits = HitsOfCorners(rig, path, view, numerical_aperture);
  if (!hits) return InView(path.name, hits.error());
  for (std::size_t i = 0; i < path.mirrors.size(); ++i) {
    MirrorDesign mirror = DesignMirror(path.mirrors[i], *hits, i, options);
    mirror.plate.path = static_cast<int>(index);
    mirror.plate.name = PlateName(path, i);
    mirror.incidence_rad = view.middle_ray.hits[i].incidence_rad;
    view.plates.push_back(mirror);
  }
  return view;
}

}  // namespace telestrain
