#include "viz/scene/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace telestrain::viz {
namespace {

constexpr int kRoundSegments = 96;
constexpr int kArrowSegments = 20;
constexpr int kMeridians = 24, kParallels = 12;

// Two directions that span the plane across `axis`; right-handed with it.
std::pair<Eigen::Vector3d, Eigen::Vector3d> Across(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d first = axis.unitOrthogonal();
  return {first, axis.cross(first).normalized()};
}

int AddPoint(const Eigen::Vector3d& point, Mesh* mesh) {
  mesh->points_in_array_mm.push_back(point);
  return static_cast<int>(mesh->points_in_array_mm.size()) - 1;
}

void AddFace(const Rectangle& corners, Mesh* mesh) {
  std::vector<int> face;
  for (const Eigen::Vector3d& corner : corners) face.push_back(AddPoint(corner, mesh));
  mesh->faces.push_back(face);
}

std::vector<int> AddCircle(const Eigen::Vector3d& center, const Eigen::Vector3d& axis,
                           double radius_mm, Mesh* mesh) {
  const auto [u, v] = Across(axis);
  std::vector<int> circle;
  for (int i = 0; i < kArrowSegments; ++i) {
    const double angle = 2 * std::numbers::pi * i / kArrowSegments;
    circle.push_back(
        AddPoint(center + radius_mm * (std::cos(angle) * u + std::sin(angle) * v), mesh));
  }
  return circle;
}

void JoinCircles(const std::vector<int>& from, const std::vector<int>& to, Mesh* mesh) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::size_t next = (i + 1) % from.size();
    mesh->faces.push_back({from[i], from[next], to[next], to[i]});
  }
}

}  // namespace

void Mesh::Append(const Mesh& other) {
  const auto first = static_cast<int>(points_in_array_mm.size());
  points_in_array_mm.insert(points_in_array_mm.end(), other.points_in_array_mm.begin(),
                            other.points_in_array_mm.end());
  for (std::vector<int> face : other.faces) {
    for (int& index : face) index += first;
    faces.push_back(std::move(face));
  }
  for (const auto& [from, to] : other.lines) lines.push_back({from + first, to + first});
}

Mesh BoxBetween(const Rectangle& near, const Rectangle& far) {
  // Counter-clockwise from outside, whichever way the rectangles turn.
  const Eigen::Vector3d normal = (near[1] - near[0]).cross(near[3] - near[0]);
  const bool faces_out = normal.dot(near[0] - far[0]) > 0;
  std::vector<Rectangle> faces{near, far};
  std::reverse(faces[1].begin(), faces[1].end());
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    faces.push_back({near[next], near[i], far[i], far[next]});
  }
  Mesh box;
  for (Rectangle& face : faces) {
    if (!faces_out) std::reverse(face.begin(), face.end());
    AddFace(face, &box);
  }
  return box;
}

Mesh Sheet(const std::vector<Eigen::Vector3d>& outline) {
  Mesh sheet;
  std::vector<int> face;
  for (const Eigen::Vector3d& corner : outline) face.push_back(AddPoint(corner, &sheet));
  if (face.size() >= 3) sheet.faces.push_back(face);
  return sheet;
}

Mesh Sheet(const Rectangle& outline) {
  return Sheet(std::vector<Eigen::Vector3d>(outline.begin(), outline.end()));
}

Mesh TubeWall(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_mm) {
  const Eigen::Vector3d axis = (to - from).normalized();
  const auto start = Ring(from, axis, radius_mm), end = Ring(to, axis, radius_mm);
  Mesh wall;
  for (std::size_t i = 0; i < start.size(); ++i)
    AddFace({start[i].first, start[i].second, end[i].second, end[i].first}, &wall);
  return wall;
}

Mesh Arrow(const Segment& from_to, double thickness_mm) {
  const Eigen::Vector3d along = from_to.second - from_to.first;
  const double length_mm = along.norm();
  Mesh arrow;
  if (length_mm <= 0) return arrow;
  const Eigen::Vector3d axis = along / length_mm;
  const double head_mm = std::min(0.6 * length_mm, 3.6 * thickness_mm);
  const Eigen::Vector3d neck = from_to.second - head_mm * axis;
  const auto tail = AddCircle(from_to.first, axis, 0.5 * thickness_mm, &arrow);
  const auto shaft_end = AddCircle(neck, axis, 0.5 * thickness_mm, &arrow);
  const auto head = AddCircle(neck, axis, 1.4 * thickness_mm, &arrow);
  const int tip = AddPoint(from_to.second, &arrow);
  arrow.faces.emplace_back(tail.rbegin(), tail.rend());
  JoinCircles(tail, shaft_end, &arrow);
  JoinCircles(shaft_end, head, &arrow);
  for (std::size_t i = 0; i < head.size(); ++i)
    arrow.faces.push_back({head[i], head[(i + 1) % head.size()], tip});
  return arrow;
}

Mesh Ellipsoid(const Eigen::Vector3d& center_in_array_mm, const Eigen::Matrix3d& half_axes_mm) {
  const double sense = half_axes_mm.determinant() < 0 ? -1 : 1;
  Mesh body;
  for (int row = 0; row <= kParallels; ++row)
    for (int column = 0; column < kMeridians; ++column) {
      const double polar = std::numbers::pi * row / kParallels;
      const double turn = sense * 2 * std::numbers::pi * column / kMeridians;
      const Eigen::Vector3d unit(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                 std::cos(polar));
      AddPoint(center_in_array_mm + half_axes_mm * unit, &body);
    }
  for (int row = 0; row < kParallels; ++row)
    for (int column = 0; column < kMeridians; ++column) {
      const int next = (column + 1) % kMeridians;
      const int above = row * kMeridians, below = above + kMeridians;
      if (row == 0)
        body.faces.push_back({above + column, below + column, below + next});
      else if (row == kParallels - 1)
        body.faces.push_back({above + column, below + column, above + next});
      else
        body.faces.push_back({above + column, below + column, below + next, above + next});
    }
  return body;
}

Mesh Lines(const std::vector<Segment>& segments) {
  Mesh mesh;
  for (const auto& [from, to] : segments) {
    const int first = AddPoint(from, &mesh);
    mesh.lines.push_back({first, AddPoint(to, &mesh)});
  }
  return mesh;
}

std::vector<Segment> EdgesOf(const Rectangle& outline) {
  return ClosedLine({outline.begin(), outline.end()});
}

std::vector<Segment> EdgesBetween(const Rectangle& near, const Rectangle& far) {
  std::vector<Segment> edges;
  for (std::size_t i = 0; i < 4; ++i) edges.emplace_back(near[i], far[i]);
  return edges;
}

std::vector<Segment> ClosedLine(const std::vector<Eigen::Vector3d>& corners) {
  std::vector<Segment> line;
  for (std::size_t i = 0; i < corners.size(); ++i)
    line.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
  return line;
}

std::vector<Segment> OpenLine(const std::vector<Eigen::Vector3d>& corners) {
  std::vector<Segment> line;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    line.emplace_back(corners[i], corners[i + 1]);
  return line;
}

std::vector<Segment> Ring(const Eigen::Vector3d& center, const Eigen::Vector3d& axis,
                          double radius_mm) {
  const auto [first, second] = Across(axis);
  const auto at = [&, &u = first, &v = second](int i) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * (i % kRoundSegments) / kRoundSegments;
    return center + radius_mm * (std::cos(angle) * u + std::sin(angle) * v);
  };
  std::vector<Segment> ring;
  for (int i = 0; i < kRoundSegments; ++i) ring.emplace_back(at(i), at(i + 1));
  return ring;
}

}  // namespace telestrain::viz
