#include "measurement/extensometer_class.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace telestrain {
namespace {

struct ClassLimits {
  const char* name;
  double relative;             // of the reference value
  double absolute;             // in the unit of the table
  double absolute_resolution;  // the same
  double Limit(double reference) const {
    return std::max(absolute, relative * std::abs(reference));
  }
};

// ISO 9513:2012, Table 2: relative bias 0.2 to 2 %, bias 0.6 to 6 um, resolution 0.2 to 2 um.
constexpr ClassLimits kIso9513_um[] = {{"0.2", 0.002, 0.6, 0.2},
                                       {"0.5", 0.005, 1.5, 0.5},
                                       {"1", 0.01, 3.0, 1.0},
                                       {"2", 0.02, 6.0, 2.0}};

// ASTM E83, Table 1: fixed and variable error of strain, fixed resolution; class E is left out.
constexpr ClassLimits kAstmE83_microstrain[] = {{"A", 0.001, 20, 10},
                                                {"B-1", 0.005, 100, 50},
                                                {"B-2", 0.005, 200, 100},
                                                {"C", 0.01, 1000, 500},
                                                {"D", 0.01, 10000, 5000}};

template <std::size_t N>
const ClassLimits* Best(const ClassLimits (&table)[N], const std::vector<ClassPoint>& points,
                        std::optional<double> resolution, bool with_uncertainty) {
  for (const ClassLimits& limits : table) {
    const bool holds = std::all_of(points.begin(), points.end(), [&](const ClassPoint& p) {
      const double reach = with_uncertainty ? p.expanded_uncertainty : 0;
      return std::abs(p.indicated - p.reference) + reach <= limits.Limit(p.reference);
    });
    if (holds && resolution.value_or(0) <= limits.absolute_resolution) return &limits;
  }
  return nullptr;
}

template <std::size_t N>
ExtensometerClass Classify(const ClassLimits (&table)[N], const std::vector<ClassPoint>& points,
                           std::optional<double> resolution) {
  ExtensometerClass result;
  const ClassLimits* best = Best(table, points, resolution, false);
  const ClassLimits* proven = Best(table, points, resolution, true);
  if (best) result.name = best->name;
  if (proven) result.proven = proven->name;
  result.count = static_cast<int>(points.size());
  result.resolution = resolution;
  const ClassLimits& shown = best ? *best : table[N - 1];
  if (resolution) result.resolution_limit = shown.absolute_resolution;
  double least_room = std::numeric_limits<double>::infinity();
  for (const ClassPoint& p : points) {
    result.range = std::max(result.range, std::abs(p.reference));
    const double error = p.indicated - p.reference, limit = shown.Limit(p.reference);
    if (limit - std::abs(error) >= least_room) continue;
    least_room = limit - std::abs(error);
    result.worst_image = p.image;
    result.worst_error = error;
    result.worst_limit = limit;
  }
  return result;
}

std::vector<std::string> NotCovered(const ExtensometerClass& result) {
  std::vector<std::string> list = {
      "The reference is the strain gauges on the pipe, not a calibrator of displacements with a "
      "certificate: number, spacing and repetition of the standard's points are not those of this "
      "sequence.",
      "The error of the gauge length is not decided: the base is measured by the calibrated array "
      "itself.",
      "The class holds up to the largest value compared; beyond it nothing was shown."};
  if (!result.resolution)
    list.push_back("The resolution is not decided: fewer than three states without strain.");
  return list;
}

}  // namespace

std::optional<ExtensometerClass> ClassifyIso9513(const std::vector<ClassPoint>& points,
                                                 std::optional<double> resolution_microstrain,
                                                 double base_length_mm) {
  if (points.empty() || !(base_length_mm > 0)) return {};
  const double um_per_microstrain = 1e-3 * base_length_mm;
  std::vector<ClassPoint> elongations = points;
  for (ClassPoint& p : elongations) {
    p.indicated *= um_per_microstrain;
    p.reference *= um_per_microstrain;
    p.expanded_uncertainty *= um_per_microstrain;
  }
  if (resolution_microstrain) *resolution_microstrain *= um_per_microstrain;
  ExtensometerClass result = Classify(kIso9513_um, elongations, resolution_microstrain);
  result.standard = "ISO 9513:2012, Table 2";
  result.unit = "µm";
  result.not_covered = NotCovered(result);
  return result;
}

std::optional<ExtensometerClass> ClassifyAstmE83(const std::vector<ClassPoint>& points,
                                                 std::optional<double> resolution_microstrain) {
  if (points.empty()) return {};
  ExtensometerClass result = Classify(kAstmE83_microstrain, points, resolution_microstrain);
  result.standard = "ASTM E83, Table 1";
  result.unit = "µε";
  result.not_covered = NotCovered(result);
  return result;
}

}  // namespace telestrain
