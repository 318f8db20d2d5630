#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>

#include "base/numbers.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene/scene_parts.h"

namespace telestrain::viz {
namespace {

constexpr double kPipeOpacity = 0.22;

std::string StateName(const Scene& scene, std::size_t state) {
  const PipeState& at = scene.pipe->states[state];
  return "state " + std::to_string(state) + " (cycle " + at.cycle + ", step " + at.step + ")";
}

std::string GroupName(const Scene& scene, int group) {
  const auto groups = scene.Groups();
  const auto index = static_cast<std::size_t>(group);
  return index < groups.size() ? groups[index] : std::to_string(group);
}

double Along_mm(const Pipe& pipe, const Eigen::Vector3d& point) {
  return (point - pipe.axis_point_in_array_mm).dot(pipe.axis_in_array);
}

std::vector<Segment> PatchEdge(const Surface& surface, int group) {
  std::map<std::pair<int, int>, int> uses;  // of an edge, by its points in ascending order
  for (const std::array<int, 4>& quad : surface.quads) {
    if (surface.group[static_cast<std::size_t>(quad[0])] != group) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [low, high] = std::minmax(quad[i], quad[(i + 1) % 4]);
      ++uses[{low, high}];
    }
  }
  std::vector<Segment> edge;
  for (const auto& [points, count] : uses)
    if (count == 1)
      edge.emplace_back(surface.points_in_array_mm[static_cast<std::size_t>(points.first)],
                        surface.points_in_array_mm[static_cast<std::size_t>(points.second)]);
  return edge;
}

// The points, quads and values of one group, numbered anew.
Part Patch(const Scene& scene, std::size_t state, int group) {
  const Surface& surface = scene.pipe->states[state].surface;
  Part part;
  part.name = StateName(scene, state) + ": surface " + GroupName(scene, group);
  part.layer = Layer::kSurface;
  part.state = static_cast<int>(state);
  part.color = kPipeColor;
  for (const PointValues& values : surface.values) part.values.push_back({values.quantity, {}});
  std::vector<int> number(surface.group.size(), -1);
  for (std::size_t i = 0; i < surface.group.size(); ++i) {
    if (surface.group[i] != group) continue;
    number[i] = static_cast<int>(part.mesh.points_in_array_mm.size());
    part.mesh.points_in_array_mm.push_back(surface.points_in_array_mm[i]);
    for (std::size_t k = 0; k < surface.values.size(); ++k)
      part.values[k].values.push_back(surface.values[k].values[i]);
  }
  for (const std::array<int, 4>& quad : surface.quads) {
    if (surface.group[static_cast<std::size_t>(quad[0])] != group) continue;
    std::vector<int> face;
    for (const int point : quad) face.push_back(number[static_cast<std::size_t>(point)]);
    part.mesh.faces.push_back(face);
  }
  part.facts = {{"state", StateName(scene, state)}, {"group", GroupName(scene, group)}};
  return part;
}

Part Edge(const Scene& scene, std::size_t state, int group) {
  Part part;
  part.name = StateName(scene, state) + ": edge of region " + GroupName(scene, group);
  part.layer = Layer::kSurface;
  part.state = static_cast<int>(state);
  part.mesh = Lines(PatchEdge(scene.pipe->states[state].surface, group));
  part.color = kInk;
  part.line_width_pt = 0.5;
  return part;
}

// Points so far apart that their arrows do not hide each other.
std::vector<std::size_t> Thinned(const Surface& surface, double apart_mm) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < surface.points_in_array_mm.size(); ++i) {
    const auto near = [&](std::size_t other) {
      return (surface.points_in_array_mm[other] - surface.points_in_array_mm[i]).norm() < apart_mm;
    };
    if (std::none_of(kept.begin(), kept.end(), near)) kept.push_back(i);
  }
  return kept;
}

// Whether a group's surface moves away from the axis on the whole: arrows that begin at their point
// are hidden by the pipe when it does not, arrows that end there when it does.
bool MovesOutwards(const Pipe& pipe, const Surface& surface, int group) {
  double sum = 0;
  for (std::size_t i = 0; i < surface.displacement_mm.size(); ++i) {
    if (surface.group[i] != group) continue;
    const Eigen::Vector3d& point = surface.points_in_array_mm[i];
    const Eigen::Vector3d foot =
        pipe.axis_point_in_array_mm + Along_mm(pipe, point) * pipe.axis_in_array;
    sum += surface.displacement_mm[i].dot(point - foot);
  }
  return sum >= 0;
}

}  // namespace

std::array<double, 2> SpanOf(const Pipe& pipe) {
  std::array<double, 2> span_mm{std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::lowest()};
  for (const Eigen::Vector3d& point : pipe.Largest().surface.points_in_array_mm) {
    const double along_mm = Along_mm(pipe, point);
    span_mm = {std::min(span_mm[0], along_mm), std::max(span_mm[1], along_mm)};
  }
  return span_mm;
}

std::array<double, 2> DrawnSpanOf(const Pipe& pipe) {
  std::array<double, 2> span_mm = SpanOf(pipe);
  for (const Gauge& gauge : pipe.gauges) {
    const double along_mm = Along_mm(pipe, gauge.center_in_array_mm);
    span_mm = {std::min(span_mm[0], along_mm - 0.5 * gauge.length_mm),
               std::max(span_mm[1], along_mm + 0.5 * gauge.length_mm)};
  }
  return {span_mm[0] - 0.4 * pipe.radius_mm, span_mm[1] + 0.4 * pipe.radius_mm};
}

Part PipePart(const Pipe& pipe, const std::array<double, 2>& span_mm) {
  constexpr double kDrawnShare = 0.99;
  const Eigen::Vector3d from = pipe.axis_point_in_array_mm + span_mm[0] * pipe.axis_in_array;
  const Eigen::Vector3d to = pipe.axis_point_in_array_mm + span_mm[1] * pipe.axis_in_array;
  const double drawn_mm = pipe.nominal_radius_mm > 0
                              ? std::min(pipe.nominal_radius_mm, pipe.radius_mm)
                              : pipe.radius_mm;
  Part part;
  part.name = "nominal pipe";
  part.layer = Layer::kPipe;
  part.mesh = TubeWall(from, to, kDrawnShare * drawn_mm);
  for (const Eigen::Vector3d& end : {from, to})
    part.mesh.Append(Lines(Ring(end, pipe.axis_in_array, kDrawnShare * drawn_mm)));
  part.color = kPipeColor;
  part.opacity = kPipeOpacity;
  part.lit = true;
  part.facts = {{"measured diameter", FormatFixed(pipe.Diameter_mm(), 4) + " mm"}};
  if (pipe.nominal_radius_mm > 0)
    part.facts.push_back({"nominal diameter", FormatFixed(2 * pipe.nominal_radius_mm, 4) + " mm"});
  return part;
}

std::vector<Eigen::Vector3d> OutlineOfPipe(const Pipe& pipe, const std::array<double, 2>& span_mm) {
  std::vector<Eigen::Vector3d> points;
  for (const double along_mm : span_mm) {
    const Eigen::Vector3d center = pipe.axis_point_in_array_mm + along_mm * pipe.axis_in_array;
    for (const auto& [point, next] : Ring(center, pipe.axis_in_array, pipe.radius_mm))
      points.push_back(point);
  }
  return points;
}

std::vector<Part> SurfaceParts(const Scene& scene, std::size_t state, int group) {
  std::vector<Part> parts;
  for (int i = 0; i < static_cast<int>(std::max<std::size_t>(scene.Groups().size(), 2)); ++i) {
    if (group >= 0 && i != group) continue;
    Part patch = Patch(scene, state, i);
    if (patch.mesh.points_in_array_mm.empty()) continue;
    parts.push_back(std::move(patch));
    parts.push_back(Edge(scene, state, i));
  }
  return parts;
}

std::vector<Eigen::Vector3d> PointsOfGroup(const Surface& surface, int group) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < surface.points_in_array_mm.size(); ++i)
    if (surface.group[i] == group) points.push_back(surface.points_in_array_mm[i]);
  return points;
}

double DisplacementFactor(const Scene& scene) {
  double largest_mm = 0;
  if (!scene.pipe) return 1;
  for (const PipeState& state : scene.pipe->states)
    for (const Eigen::Vector3d& displacement : state.surface.displacement_mm)
      largest_mm = std::max(largest_mm, displacement.norm());
  return largest_mm > 0 ? RoundDown(0.1 * scene.pipe->base_length_mm / largest_mm) : 1;
}

std::vector<Part> DisplacementParts(const Scene& scene, std::size_t state, double factor) {
  const Surface& surface = scene.pipe->states[state].surface;
  Part part;
  part.name = StateName(scene, state) + ": displacement";
  part.layer = Layer::kDisplacements;
  part.state = static_cast<int>(state);
  part.color = kArrowColor;
  part.lit = true;
  if (surface.displacement_mm.empty()) return {};
  constexpr double kApart = 0.22, kThickness = 0.016;  // shares of the pipe's radius
  std::map<int, bool> outwards;
  for (const int group : surface.group)
    if (!outwards.contains(group)) outwards[group] = MovesOutwards(*scene.pipe, surface, group);
  for (const std::size_t i : Thinned(surface, kApart * scene.pipe->radius_mm)) {
    const Eigen::Vector3d drawn = factor * surface.displacement_mm[i];
    // The reference state's own displacement is rounding.
    if (surface.displacement_mm[i].norm() < 1e-6) continue;
    const Eigen::Vector3d& point = surface.points_in_array_mm[i];
    const Segment arrow =
        outwards[surface.group[i]] ? Segment{point, point + drawn} : Segment{point - drawn, point};
    part.mesh.Append(Arrow(arrow, kThickness * scene.pipe->radius_mm));
  }
  if (part.mesh.faces.empty()) return {};
  part.facts = {{"state", StateName(scene, state)},
                {"displacement", "from the reference state, drawn " + FormatShortest(factor) +
                                     " times its length"}};
  return {part};
}

std::vector<Part> GaugeParts(const Scene& scene) {
  std::vector<Part> parts;
  if (!scene.pipe) return parts;
  const Pipe& pipe = *scene.pipe;
  for (std::size_t i = 0; i < pipe.gauges.size(); ++i) {
    const Gauge& gauge = pipe.gauges[i];
    // A gauge whose length is not stated is drawn as a small plate.
    const double length_mm = gauge.length_mm > 0 ? gauge.length_mm : 0.3 * pipe.radius_mm;
    const Eigen::Vector3d along = 0.5 * length_mm * pipe.axis_in_array;
    const Eigen::Vector3d across =
        0.25 * length_mm * gauge.outward_in_array.cross(pipe.axis_in_array).normalized();
    const Eigen::Vector3d middle =
        gauge.center_in_array_mm + 0.01 * pipe.radius_mm * gauge.outward_in_array;
    const Rectangle plate{middle - along - across, middle + along - across, middle + along + across,
                          middle - along + across};
    Part part;
    part.name = "gauge " + gauge.name;
    part.layer = Layer::kGauges;
    part.mesh = Sheet(plate);
    part.mesh.Append(Lines(EdgesOf(plate)));
    part.color = kGaugeColor;
    part.opacity = 0.9;
    part.facts = {{"strain gauge", gauge.name}};
    if (gauge.length_mm > 0)
      part.facts.push_back({"length", FormatFixed(gauge.length_mm, 2) + " mm"});
    for (std::size_t k = 0; k < pipe.states.size(); ++k)
      if (const auto& read = pipe.states[k].gauge_microstrain; i < read.size() && read[i])
        part.facts.push_back({StateName(scene, k), NumberText(*read[i], 1) + " \u00b5\u03b5"});
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace telestrain::viz
