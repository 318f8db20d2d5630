#include "optics/rig_design.h"

#include <algorithm>
#include <cmath>

#include "optics/rig_parts.h"

namespace telestrain {
namespace {

constexpr double kWavelength_mm = 0.55e-3;  // green, where the eye and silicon are sensitive
// What rounding may add to a value that is compared with a limit of its own size.
constexpr double kRounding = 1e-9;

DesignCheck AtMost(std::string what, double value, double limit, std::string unit) {
  return {std::move(what), value, limit, std::move(unit), true, value <= limit + kRounding};
}

DesignCheck AtLeast(std::string what, double value, double limit, std::string unit) {
  return {std::move(what), value, limit, std::move(unit), false, value >= limit - kRounding};
}

template <typename Member>
double Largest(const std::vector<ViewDesign>& views, Member member) {
  double largest = 0;
  for (const ViewDesign& view : views) largest = std::max(largest, view.*member);
  return largest;
}

}  // namespace

double DiffractionAperture(double depth_of_field_mm) {
  return std::min(std::sqrt(kWavelength_mm / depth_of_field_mm), 1.0);
}

bool RigDesign::AllHold() const {
  return std::all_of(checks.begin(), checks.end(), [](const DesignCheck& c) { return c.ok; });
}

void CheckDesign(const OpticalRig& rig, const DesignLimits& limits, RigDesign& design) {
  std::vector<DesignCheck>& checks = design.checks;
  double deepest_mm = 0;
  for (const PairDesign& pair : design.pairs) {
    const std::string names = pair.first + " and " + pair.second;
    checks.push_back(
        AtLeast("overlap of " + names, pair.overlap_percent, limits.smallest_overlap_percent, "%"));
    checks.push_back(
        AtMost("depth spread of " + names, pair.depth_spread_mm, rig.depth_of_field_mm, "mm"));
    deepest_mm = std::max(deepest_mm, pair.depth_spread_mm);
  }
  // One focus serves all views: what the patches leave of the depth of field.
  checks.push_back(AtMost("path difference between views", design.path_spread_mm,
                          std::max(0.0, rig.depth_of_field_mm - deepest_mm), "mm"));
  const auto odd_ones = std::count_if(
      design.views.begin(), design.views.end(),
      [&](const ViewDesign& v) { return v.handedness != design.views.front().handedness; });
  checks.push_back(
      AtMost("views of another handedness than the first", static_cast<double>(odd_ones), 0, ""));
  if (rig.needed_field_mm)
    checks.push_back(
        AtLeast("total field along the pipe", design.total_field_mm, *rig.needed_field_mm, "mm"));
  checks.push_back(AtMost("pixels whose chief ray misses a mirror",
                          Largest(design.views, &ViewDesign::chief_loss_percent), 0, "%"));
  checks.push_back(AtMost("light lost at mirror edges, mean",
                          Largest(design.views, &ViewDesign::light_loss_percent),
                          limits.largest_light_loss_percent, "%"));
  checks.push_back(AtMost("light blocked by other mirrors",
                          Largest(design.views, &ViewDesign::blocked_percent), 0, "%"));
  checks.push_back(
      AtMost("mirrors that cut each other", static_cast<double>(design.overlapping_plates), 0, ""));
}

Result<RigDesign> AnalyseRig(const OpticalRig& rig, const DesignOptions& options) {
  if (rig.paths.empty()) return BadInput("the rig has no view; describe one path at least");
  if (std::isnan(options.numerical_aperture) || std::isnan(options.mirror_margin_mm))
    return Error{
        ErrorKind::kUsage,
        "numerical aperture and mirror margin must be numbers; leave an option out for its "
        "default"};
  RigDesign design;
  design.numerical_aperture = options.numerical_aperture > 0
                                  ? options.numerical_aperture
                                  : DiffractionAperture(rig.depth_of_field_mm);
  for (std::size_t i = 0; i < rig.paths.size(); ++i) {
    TELESTRAIN_ASSIGN_OR_RETURN(design.views.emplace_back(),
                                DesignView(rig, i, options, design.numerical_aperture));
  }
  PartAllPlates(design);
  FindLosses(rig, design);
  DesignPairs(rig, design);
  design.sensitivities = SensitivityOf(rig);
  CheckDesign(rig, options.limits, design);
  return design;
}

}  // namespace telestrain
