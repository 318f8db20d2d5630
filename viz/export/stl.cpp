#include "viz/export/stl.h"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "viz/export/little_endian.h"
#include "viz/export/shown_values.h"

namespace telestrain::viz {
namespace {

constexpr std::size_t kHeaderBytes = 80;

using Triangle = std::array<Eigen::Vector3d, 3>;

Eigen::Vector3d NormalOf(const Triangle& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

Eigen::Vector3d Outward(const Pipe& pipe, const Eigen::Vector3d& point_in_array_mm) {
  const Eigen::Vector3d offset = point_in_array_mm - pipe.axis_point_in_array_mm;
  return offset - offset.dot(pipe.axis_in_array) * pipe.axis_in_array;
}

void Append(const Eigen::Vector3d& vector, std::string* bytes) {
  for (int i = 0; i < 3; ++i) AppendLittleEndian(static_cast<float>(vector[i]), bytes);
}

void Append(const Pipe& pipe, Triangle triangle, std::string* bytes) {
  if (NormalOf(triangle).dot(Outward(pipe, triangle[0])) < 0) std::swap(triangle[1], triangle[2]);
  Append(NormalOf(triangle), bytes);
  for (const Eigen::Vector3d& corner : triangle) Append(corner, bytes);
  AppendLittleEndian(std::uint16_t{0}, bytes);  // "attribute byte count", unused
}

// Exactly 80 bytes of plain ASCII, whatever the session calls its steps.
std::string HeaderOf(const Pipe& pipe, std::size_t state) {
  // Must not begin with "solid": that word marks the text variant.
  std::string text = "telestrain pipe surface, unit mm, array frame, " + StateText(pipe, state);
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  text.resize(kHeaderBytes, ' ');
  return text;
}

}  // namespace

std::string StlBytes(const Pipe& pipe, std::size_t state) {
  const Surface& surface = pipe.states[state].surface;
  std::string bytes = HeaderOf(pipe, state);
  AppendLittleEndian(static_cast<std::uint32_t>(2 * surface.quads.size()), &bytes);
  for (const std::array<int, 4>& quad : surface.quads) {
    std::array<Eigen::Vector3d, 4> p;
    for (std::size_t i = 0; i < 4; ++i)
      p[i] = surface.points_in_array_mm[static_cast<std::size_t>(quad[i])];
    Append(pipe, {p[0], p[1], p[2]}, &bytes);
    Append(pipe, {p[0], p[2], p[3]}, &bytes);
  }
  return bytes;
}

}  // namespace telestrain::viz
