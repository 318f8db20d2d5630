#include <cmath>
#include <string>

#include "base/numbers.h"
#include "simulation/virtual_experiment.h"

namespace telestrain {
namespace {

using Options = VirtualExperimentOptions;

// Below it diffraction alone blurs more than a tenth of a board's square.
constexpr double kSmallestAperture = 0.005;
constexpr double kSmallestBendRadius_mm = 100;
// The sharpest bend of a cold-bent hydraulic tube; its inner side then still has a length.
constexpr double kLeastBend_diameters = 3;

Error OutOfRange(const std::string& name, const std::string& found, const std::string& limit) {
  return {ErrorKind::kUsage, "virtual experiment: " + name + " is " + found + ", wanted " + limit +
                                 "; choose a value inside"};
}

Status CheckRange(const VirtualExperimentOptionInfo& info, double value) {
  if (value >= info.minimum && value <= info.maximum) return {};
  const std::string unit = *info.unit == '\0' ? "" : std::string(" ") + info.unit;
  return OutOfRange(info.name, FormatShortest(value) + unit,
                    FormatShortest(info.minimum) + " to " + FormatShortest(info.maximum) + unit);
}

Status CheckCombinations(const Options& options) {
  const int bits = options.bit_depth;
  if (bits != 8 && bits != 10 && bits != 12 && bits != 16)
    return OutOfRange("bit_depth", std::to_string(bits), "8, 10, 12 or 16");
  const double aperture = options.numerical_aperture, radius_mm = options.pipe_bend_radius_mm;
  if (aperture != 0 && aperture < kSmallestAperture)
    return OutOfRange("numerical_aperture", FormatShortest(aperture), "0, or 0.005 or more");
  if (radius_mm != 0 && std::abs(radius_mm) < kSmallestBendRadius_mm)
    return OutOfRange("pipe_bend_radius_mm", FormatShortest(radius_mm) + " mm",
                      "0, or 100 mm or more to either side");
  if (radius_mm != 0 && std::abs(radius_mm) < kLeastBend_diameters * options.pipe_diameter_mm)
    return OutOfRange("pipe_bend_radius_mm", FormatShortest(radius_mm) + " mm",
                      "0, or at least 3 times pipe_diameter_mm to either side");
  if (2 * options.wall_thickness_mm >= options.pipe_diameter_mm)
    return OutOfRange("wall_thickness_mm", FormatShortest(options.wall_thickness_mm) + " mm",
                      "less than half of pipe_diameter_mm");
  if (options.cut_off_poses > options.poses - 3)
    return OutOfRange("cut_off_poses", std::to_string(options.cut_off_poses),
                      "at most poses - 3 = " + std::to_string(options.poses - 3));
  if (options.pipe_states > 0 && options.pipe_states < 3)
    return OutOfRange("pipe_states", std::to_string(options.pipe_states), "0 or at least 3");
  if (options.pipe_states > 0 && 2 * options.load_cycles > options.pipe_states - 1)
    return OutOfRange(
        "load_cycles", std::to_string(options.load_cycles),
        "at most (pipe_states - 1) / 2 = " + std::to_string((options.pipe_states - 1) / 2));
  return {};
}

}  // namespace

Status CheckVirtualExperimentOptions(const Options& options) {
  for (const VirtualExperimentOptionInfo& info : VirtualExperimentOptionTable()) {
    const double value = std::visit(
        [&options](auto member) { return static_cast<double>(options.*member); }, info.member);
    TELESTRAIN_RETURN_IF_ERROR(CheckRange(info, value));
  }
  return CheckCombinations(options);
}

}  // namespace telestrain
