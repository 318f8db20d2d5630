#include "viz/desk/pick.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/numbers.h"

namespace telestrain::viz {
namespace {

constexpr double kOpaque = 0.5;  // one looks at such a face, not through it

struct Hit {
  double depth_mm = std::numeric_limits<double>::infinity();  // along the line of sight
  const std::vector<int>* face = nullptr;                     // null: a line was met
};

// Depth at which the line of sight goes through a triangle (T. Moeller and B. Trumbore, 1997).
std::optional<double> DepthInTriangle(const SightLine& sight, const Eigen::Vector3d& a,
                                      const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, p = sight.away.cross(ac);
  const double determinant = ab.dot(p);
  if (std::abs(determinant) < 1e-12) return std::nullopt;  // seen from its edge
  const Eigen::Vector3d from_a = sight.point_in_array_mm - a, q = from_a.cross(ab);
  const double u = from_a.dot(p) / determinant, v = sight.away.dot(q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  return ac.dot(q) / determinant;
}

// Depth of a segment's point nearest to the line of sight when that is within reach.
std::optional<double> DepthAtSegment(const SightLine& sight, const Eigen::Vector3d& a,
                                     const Eigen::Vector3d& b, double reach_mm) {
  const Eigen::Vector3d to_a = a - sight.point_in_array_mm, along = b - a;
  const auto across = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return v - v.dot(sight.away) * sight.away;
  };
  const Eigen::Vector3d flat_a = across(to_a), flat = across(along);
  const double length2 = flat.squaredNorm();
  const double share = length2 > 0 ? std::clamp(-flat_a.dot(flat) / length2, 0.0, 1.0) : 0;
  if ((flat_a + share * flat).norm() > reach_mm) return std::nullopt;
  return (to_a + share * along).dot(sight.away);
}

Hit NearestFace(const Mesh& mesh, const SightLine& sight) {
  Hit nearest;
  const auto at = [&](int index) -> const Eigen::Vector3d& {
    return mesh.points_in_array_mm[static_cast<std::size_t>(index)];
  };
  for (const std::vector<int>& face : mesh.faces)
    for (std::size_t i = 2; i < face.size(); ++i) {
      const auto depth = DepthInTriangle(sight, at(face[0]), at(face[i - 1]), at(face[i]));
      if (depth && *depth < nearest.depth_mm) nearest = {*depth, &face};
    }
  return nearest;
}

Hit NearestLine(const Mesh& mesh, const SightLine& sight, double reach_mm) {
  Hit nearest;
  for (const auto& [from, to] : mesh.lines) {
    const auto depth =
        DepthAtSegment(sight, mesh.points_in_array_mm[static_cast<std::size_t>(from)],
                       mesh.points_in_array_mm[static_cast<std::size_t>(to)], reach_mm);
    // Lines on a surface lie in it; they are drawn in front of it and are met in front of it.
    if (depth && *depth - reach_mm < nearest.depth_mm) nearest = {*depth - reach_mm, nullptr};
  }
  return nearest;
}

// Whether the line of sight passes the box around the part's points.
bool MayMeet(const Mesh& mesh, const SightLine& sight, double reach_mm) {
  const Eigen::Vector3d right = sight.away.unitOrthogonal(), up = right.cross(sight.away);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& point : mesh.points_in_array_mm) {
    const Eigen::Vector3d offset = point - sight.point_in_array_mm;
    box.extend(Eigen::Vector2d(offset.dot(right), offset.dot(up)));
  }
  return !box.isEmpty() && box.exteriorDistance(Eigen::Vector2d::Zero()) <= reach_mm;
}

// The best of one class of candidates.
struct Best {
  double opacity = 0;
  Hit hit;
  std::size_t part = 0;
};

void Offer(const Hit& hit, double opacity, std::size_t part, Best* best) {
  if (!std::isfinite(hit.depth_mm)) return;
  if (opacity < best->opacity) return;
  if (opacity == best->opacity && hit.depth_mm >= best->hit.depth_mm) return;
  *best = {opacity, hit, part};
}

// The corner of the face nearest to the line of sight.
int NearestCorner(const Mesh& mesh, const std::vector<int>& face, const SightLine& sight) {
  int nearest = face.front();
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (const int corner : face) {
    const Eigen::Vector3d offset =
        mesh.points_in_array_mm[static_cast<std::size_t>(corner)] - sight.point_in_array_mm;
    const double off_mm = (offset - offset.dot(sight.away) * sight.away).norm();
    if (off_mm >= nearest_mm) continue;
    nearest_mm = off_mm;
    nearest = corner;
  }
  return nearest;
}

Pick PickOf(const DeskModel& model, const Best& best, const SightLine& sight) {
  const Part& part = model.parts()[best.part];
  Pick pick;
  pick.part = best.part;
  pick.point_in_array_mm = sight.point_in_array_mm + best.hit.depth_mm * sight.away;
  if (part.values.empty() || best.hit.face == nullptr) return pick;
  pick.measured_point = NearestCorner(part.mesh, *best.hit.face, sight);
  pick.point_in_array_mm =
      part.mesh.points_in_array_mm[static_cast<std::size_t>(*pick.measured_point)];
  return pick;
}

std::string ValueText(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "none";
  // Four significant digits, and no more than a tenth of a micrometre or microstrain needs.
  const double size = std::abs(value);
  const int digits = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : size >= 1 ? 3 : 4;
  return NumberText(value, digits) + (unit.empty() ? "" : " " + unit);
}

std::string VectorText(const Eigen::Vector3d& vector, int decimals, const std::string& unit) {
  return NumberText(vector.x(), decimals) + ", " + NumberText(vector.y(), decimals) + ", " +
         NumberText(vector.z(), decimals) + " " + unit;
}

// Index of the part's point among those of its state's surface, which it was copied from.
std::optional<std::size_t> IndexInSurface(const Surface& surface, const Eigen::Vector3d& point) {
  for (std::size_t i = 0; i < surface.points_in_array_mm.size(); ++i)
    if (surface.points_in_array_mm[i] == point) return i;
  return std::nullopt;
}

void AddPointFacts(const DeskModel& model, const Part& part, const Pick& pick,
                   std::vector<Fact>* facts) {
  facts->push_back({"position", VectorText(pick.point_in_array_mm, 4, "mm")});
  if (model.scene().pipe && part.state != kEveryState) {
    const Surface& surface =
        model.scene().pipe->states[static_cast<std::size_t>(part.state)].surface;
    const auto index = IndexInSurface(surface, pick.point_in_array_mm);
    if (index && !surface.displacement_mm.empty())
      facts->push_back(
          {"displacement", VectorText(1000 * surface.displacement_mm[*index], 2, "\u00b5m")});
  }
  for (const PointValues& values : part.values)
    facts->push_back({values.quantity.name,
                      ValueText(values.values[static_cast<std::size_t>(*pick.measured_point)],
                                values.quantity.unit)});
}

}  // namespace

std::optional<Pick> PickAt(const DeskModel& model, const SightLine& sight, double reach_mm) {
  Best solid, translucent;
  for (std::size_t i = 0; i < model.parts().size(); ++i) {
    const Part& part = model.parts()[i];
    if (!model.IsVisible(part) || !MayMeet(part.mesh, sight, reach_mm)) continue;
    const Hit face = NearestFace(part.mesh, sight);
    if (part.opacity >= kOpaque)
      Offer(face, 1, i, &solid);
    else
      Offer(face, part.opacity, i, &translucent);
    Offer(NearestLine(part.mesh, sight, reach_mm), 1, i, &solid);
  }
  const Best& best = std::isfinite(solid.hit.depth_mm) ? solid : translucent;
  if (!std::isfinite(best.hit.depth_mm)) return std::nullopt;
  return PickOf(model, best, sight);
}

std::vector<Fact> FactsOf(const DeskModel& model, const Pick& pick) {
  const Part& part = model.parts()[pick.part];
  std::vector<Fact> facts = part.facts;
  if (pick.measured_point) AddPointFacts(model, part, pick, &facts);
  return facts;
}

}  // namespace telestrain::viz
