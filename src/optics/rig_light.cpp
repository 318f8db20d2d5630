#include <algorithm>
#include <cmath>
#include <limits>

#include "optics/rig_parts.h"

namespace telestrain {
namespace {

constexpr int kColumns = 33, kRows = 25;      // pixels sampled for light that is lost
constexpr int kWayColumns = 9, kWayRows = 7;  // and for plates that stand in the way
constexpr double kFullLight = 1e-9;

using PlateList = std::vector<MirrorDesign*>;

// Those of which anything is left.
PlateList AllPlates(RigDesign& design) {
  PlateList plates;
  for (ViewDesign& view : design.views)
    for (MirrorDesign& mirror : view.plates)
      if (!mirror.plate.outline_mm.empty()) plates.push_back(&mirror);
  return plates;
}

// The middles of columns x rows equal cells of the field.
std::vector<Eigen::Vector2d> FieldSamples(const Eigen::AlignedBox2d& field_mm, int columns,
                                          int rows) {
  std::vector<Eigen::Vector2d> samples;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Eigen::Array2d share((column + 0.5) / columns, (row + 0.5) / rows);
      samples.push_back(field_mm.min() + (share * field_mm.sizes().array()).matrix());
    }
  return samples;
}

// One path with what its rays need.
struct PathLight {
  const OpticalPath* path;
  const ViewDesign* view;
  PhysicalCamera camera;  // virtual
  std::vector<Mirror> backwards;

  Eigen::Vector3d Object(const Eigen::Vector2d& ideal_mm) const {
    return ObjectPoint(camera, ideal_mm, view->focus_path_mm);
  }
  // Points from the object back to the lens' reference plane; empty when the ray misses a plate.
  std::vector<Eigen::Vector3d> Way(const Eigen::Vector3d& object_mm,
                                   const Eigen::Vector3d& towards_lens) const;
};

std::vector<Eigen::Vector3d> PathLight::Way(const Eigen::Vector3d& object_mm,
                                            const Eigen::Vector3d& towards_lens) const {
  const auto hits = HitMirrors(object_mm, towards_lens, backwards);
  if (!hits) return {};
  std::vector<Eigen::Vector3d> way{object_mm};
  for (std::size_t i = 0; i < hits->size(); ++i) {
    const MirrorPlate& plate = view->plates[hits->size() - 1 - i].plate;
    if (!Contains(plate.outline_mm, plate.InPlate((*hits)[i].point_mm))) return {};
    way.push_back((*hits)[i].point_mm);
  }
  const double rest_mm = view->focus_path_mm - (hits->empty() ? 0 : hits->back().path_mm);
  const Eigen::Vector3d last = hits->empty() ? towards_lens : hits->back().direction_after;
  way.push_back(way.back() + rest_mm * last);
  return way;
}

void FindLostLight(const PathLight& light, const std::vector<ApertureRay>& aperture,
                   ViewDesign& view) {
  const auto samples = FieldSamples(light.path->field_mm, kColumns, kRows);
  double lost = 0, worst = 0;
  int full = 0, chief_lost = 0;
  for (const Eigen::Vector2d& ideal_mm : samples) {
    const Eigen::Vector3d object_mm = light.Object(ideal_mm);
    double lost_here = 0;
    bool is_full = true;
    for (const ApertureRay& ray : aperture) {
      if (!light.Way(object_mm, ray.direction).empty()) continue;
      lost_here += ray.weight;
      is_full = false;
    }
    lost += lost_here;
    worst = std::max(worst, lost_here);
    full += is_full ? 1 : 0;
    chief_lost += light.Way(object_mm, -light.camera.axis).empty() ? 1 : 0;
  }
  const double percent = 100.0 / static_cast<double>(samples.size());
  view.light_loss_percent = lost < kFullLight ? 0 : percent * lost;
  view.worst_loss_percent = worst < kFullLight ? 0 : 100 * worst;
  view.full_light_percent = percent * full;
  view.chief_loss_percent = percent * chief_lost;
}

// The plate that stands in the way, not counting the ones that the ray is reflected at.
const MirrorPlate* Blocker(const std::vector<Eigen::Vector3d>& way, const PlateList& plates,
                           int path) {
  const int mirrors = static_cast<int>(way.size()) - 2;
  for (int part = 0; part + 1 < static_cast<int>(way.size()); ++part)
    for (const MirrorDesign* other : plates) {
      const MirrorPlate& plate = other->plate;
      // Part i runs from mirror `mirrors - i` to the next one nearer to the lens.
      const bool own = plate.path == path &&
                       (plate.mirror == mirrors - part || plate.mirror == mirrors - part - 1);
      if (!own && StandsBetween(plate, way[static_cast<std::size_t>(part)],
                                way[static_cast<std::size_t>(part) + 1]))
        return &plate;
    }
  return nullptr;
}

void FindBlockedLight(const PathLight& light, const std::vector<ApertureRay>& aperture, int path,
                      RigDesign& design) {
  const PlateList plates = AllPlates(design);
  std::vector<int> stopped(plates.size(), 0);
  int rays = 0, blocked = 0;
  for (const Eigen::Vector2d& ideal_mm : FieldSamples(light.path->field_mm, kWayColumns, kWayRows))
    for (const ApertureRay& ray : aperture) {
      const auto way = light.Way(light.Object(ideal_mm), ray.direction);
      if (way.empty()) continue;
      ++rays;
      const MirrorPlate* blocker = Blocker(way, plates, path);
      if (!blocker) continue;
      ++blocked;
      for (std::size_t i = 0; i < plates.size(); ++i)
        if (&plates[i]->plate == blocker) ++stopped[i];
    }
  if (rays == 0) return;
  design.views[static_cast<std::size_t>(path)].blocked_percent = 100.0 * blocked / rays;
  for (std::size_t i = 0; i < plates.size(); ++i)
    if (stopped[i] > 0)
      design.blocked.push_back(
          {light.path->name, plates[i]->plate.name, 100.0 * stopped[i] / rays});
}

// The nearest plate of another path to those of one view.
std::optional<PlateGap> NearestPlate(const PlateList& plates, int path) {
  std::optional<PlateGap> nearest;
  for (const MirrorDesign* own : plates)
    for (const MirrorDesign* other : plates) {
      if (own->plate.path != path || other->plate.path == path) continue;
      if (own->is_cut && other->is_cut && own->plate.mirror == other->plate.mirror) continue;
      const double gap_mm = GapBetween_mm(own->plate, other->plate);
      if (nearest && gap_mm >= nearest->gap_mm) continue;
      nearest = PlateGap{own->plate.name, other->plate.name, gap_mm, false};
    }
  return nearest;
}

}  // namespace

void PartAllPlates(RigDesign& design) {
  const PlateList plates = AllPlates(design);
  std::vector<std::pair<MirrorDesign*, MirrorDesign*>> meeting;
  for (std::size_t i = 0; i < plates.size(); ++i)
    for (std::size_t j = i + 1; j < plates.size(); ++j)
      if (plates[i]->plate.path != plates[j]->plate.path &&
          GapBetween_mm(plates[i]->plate, plates[j]->plate) == 0)
        meeting.emplace_back(plates[i], plates[j]);
  for (const auto& [first, second] : meeting) {
    PartPlates(first->plate, second->plate, first->plate.origin_mm, second->plate.origin_mm);
    first->is_cut = second->is_cut = true;
  }
  for (const auto& [first, second] : meeting) {
    if (first->plate.outline_mm.empty() || second->plate.outline_mm.empty()) continue;
    const double gap_mm = GapBetween_mm(first->plate, second->plate);
    if (gap_mm == 0) ++design.overlapping_plates;
    design.gaps.push_back({first->plate.name, second->plate.name, gap_mm, true});
  }
  for (std::size_t i = 0; i < design.views.size(); ++i)
    if (const auto gap = NearestPlate(AllPlates(design), static_cast<int>(i)))
      design.gaps.push_back(*gap);
}

void FindLosses(const OpticalRig& rig, RigDesign& design) {
  for (std::size_t i = 0; i < design.views.size(); ++i) {
    const OpticalPath& path = rig.paths[i];
    const PathLight light{&path,
                          &design.views[i],
                          VirtualCamera(rig, path),
                          {path.mirrors.rbegin(), path.mirrors.rend()}};
    const auto aperture = ApertureRays(light.camera, design.numerical_aperture);
    FindLostLight(light, aperture, design.views[i]);
    FindBlockedLight(light, aperture, static_cast<int>(i), design);
  }
}

}  // namespace telestrain
