#include <cmath>

#include "viz/results_parts.h"

namespace telestrain::viz {
namespace {

// How far a direction of strain.json may lean out of the plane across the fitted axis: the arc of a
// bent pipe and the cylinder fitted to it have axes of their own. A tenth is 6 degrees.
constexpr double kLargestLean = 0.1;

// Unit vector across the axis.
Eigen::Vector3d AcrossAxis(const JsonNode& node, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d direction = node.Direction();
  if (std::abs(axis.dot(direction)) > kLargestLean)
    node.Fail("a direction across pipe.axis_in_array is wanted");
  return (direction - axis * axis.dot(direction)).normalized();
}

// "gauge 1" from "gauge_1_microstrain".
std::string NameOf(std::string column) {
  const std::string unit = "_microstrain";
  if (column.ends_with(unit)) column.resize(column.size() - unit.size());
  for (char& sign : column)
    if (sign == '_') sign = ' ';
  return column;
}

}  // namespace

std::vector<Gauge> PlaceGauges(const JsonNode& strain, const std::vector<PipeGauge>& gauges,
                               const Pipe& pipe) {
  std::vector<Gauge> placed;
  if (gauges.empty()) return placed;
  const Eigen::Vector3d along =
      pipe.axis_in_array.x() < 0 ? Eigen::Vector3d(-pipe.axis_in_array) : pipe.axis_in_array;
  const Eigen::Vector3d nearest_to_origin_mm =
      pipe.axis_point_in_array_mm - along * along.dot(pipe.axis_point_in_array_mm);
  const JsonNode geometry = strain.At("geometry");
  const Eigen::Vector3d at_0 = AcrossAxis(geometry.At("angle_0_in_array"), along);
  Eigen::Vector3d at_90 = AcrossAxis(geometry.At("angle_90_in_array"), along);
  if (std::abs(at_0.dot(at_90)) > kLargestLean)
    geometry.At("angle_90_in_array").Fail("a direction across angle_0_in_array is wanted");
  at_90 = (at_90 - at_0 * at_0.dot(at_90)).normalized();
  for (const PipeGauge& recorded : gauges) {
    Gauge gauge;
    gauge.name = NameOf(recorded.column);
    gauge.outward_in_array =
        std::cos(recorded.angle_rad) * at_0 + std::sin(recorded.angle_rad) * at_90;
    gauge.center_in_array_mm =
        nearest_to_origin_mm + recorded.axial_mm * along + pipe.radius_mm * gauge.outward_in_array;
    gauge.length_mm = recorded.length_mm;
    placed.push_back(gauge);
  }
  return placed;
}

}  // namespace telestrain::viz
