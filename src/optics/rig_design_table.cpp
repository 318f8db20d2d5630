#include <algorithm>
#include <numbers>

#include "base/numbers.h"
#include "optics/rig_design_output.h"

namespace telestrain {
namespace {

using Row = std::vector<std::string>;

double Degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

std::string SizeText(const Eigen::Vector2d& size_mm, int decimals) {
  return FormatFixed(size_mm.x(), decimals) + " x " + FormatFixed(size_mm.y(), decimals);
}

std::string OptionalText(const std::optional<double>& value, int decimals) {
  return value ? FormatFixed(*value, decimals) : "-";
}

// Columns as wide as their longest cell; the first one to the left, the others to the right.
void AddTable(std::vector<std::string>& lines, const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string fill(widths[i] - row[i].size(), ' ');
      line += i == 0 ? row[i] + fill : "  " + fill + row[i];
    }
    while (line.ends_with(' ')) line.pop_back();
    lines.push_back(line);
  }
  lines.emplace_back();
}

std::vector<Row> ViewRows(const RigDesign& design) {
  std::vector<Row> rows{
      {"view", "group", "mirrors", "image", "field/mm", "footprint/mm", "path/mm", "from M1/mm"}};
  for (const ViewDesign& view : design.views) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& corner : view.footprint_mm) box.extend(corner);
    rows.push_back({view.name, view.group, std::to_string(view.mirrors),
                    view.handedness < 0 ? "mirrored" : "upright", SizeText(view.field_mm, 3),
                    SizeText(box.sizes(), 3), FormatFixed(view.focus_path_mm, 2),
                    FormatFixed(view.first_mirror_path_mm, 2)});
  }
  return rows;
}

std::vector<Row> MirrorRows(const RigDesign& design) {
  std::vector<Row> rows{
      {"mirror", "incidence/deg", "chief rays/mm", "with aperture/mm", "mirror/mm", "shared edge"}};
  for (const ViewDesign& view : design.views)
    for (const MirrorDesign& mirror : view.plates)
      rows.push_back({mirror.plate.name, FormatFixed(Degrees(mirror.incidence_rad), 2),
                      SizeText(mirror.chief_size_mm, 2), SizeText(mirror.needed_size_mm, 2),
                      SizeText(mirror.plate.Size_mm(), 2), mirror.is_cut ? "yes" : "no"});
  return rows;
}

std::vector<Row> LightRows(const RigDesign& design) {
  std::vector<Row> rows{{"light of", "chief rays lost/%", "lost mean/%", "worst pixel/%",
                         "pixels with all/%", "blocked/%"}};
  for (const ViewDesign& view : design.views)
    rows.push_back({view.name, FormatFixed(view.chief_loss_percent, 2),
                    FormatFixed(view.light_loss_percent, 2),
                    FormatFixed(view.worst_loss_percent, 2),
                    FormatFixed(view.full_light_percent, 2), FormatFixed(view.blocked_percent, 2)});
  return rows;
}

std::vector<Row> PairRows(const RigDesign& design) {
  std::vector<Row> rows{
      {"pair", "stereo/deg", "overlap/%", "common/mm", "depth/mm", "arc seen/mm", "arc sharp/mm"}};
  for (const PairDesign& pair : design.pairs)
    rows.push_back({pair.first + "-" + pair.second, FormatFixed(Degrees(pair.stereo_angle_rad), 2),
                    FormatFixed(pair.overlap_percent, 1), SizeText(pair.common_mm, 3),
                    FormatFixed(pair.depth_spread_mm, 3), OptionalText(pair.seen_arc_mm, 2),
                    OptionalText(pair.sharp_arc_mm, 2)});
  return rows;
}

std::vector<Row> ArrayRows(const RigDesign& design) {
  return {{"array", "mm"},
          {"total field along the pipe", FormatFixed(design.total_field_mm, 3)},
          {"gap between the groups' fields", OptionalText(design.field_gap_mm, 3)},
          {"distance of the groups' centres", OptionalText(design.base_length_mm, 3)},
          {"path difference between views", FormatFixed(design.path_spread_mm, 3)}};
}

std::vector<Row> GapRows(const RigDesign& design) {
  std::vector<Row> rows{{"mirrors of different paths", "gap/mm"}};
  for (const PlateGap& gap : design.gaps)
    if (!gap.shared_edge)
      rows.push_back({gap.first + " to " + gap.second, FormatFixed(gap.gap_mm, 2)});
  return rows;
}

std::string NameOf(MirrorError error) {
  switch (error) {
    case MirrorError::kTurnInPlane:
      return "1 mrad in plane";
    case MirrorError::kTurnAcross:
      return "1 mrad across";
    case MirrorError::kShift:
      return "10 um";
  }
  return "";
}

std::vector<Row> SensitivityRows(const RigDesign& design) {
  std::vector<Row> rows{{"mirror off by", "field/mm", "field/px", "axis/mrad", "roll/mrad",
                         "stereo/mrad", "length/um", "strain/ue"}};
  for (const MirrorSensitivity& s : design.sensitivities)
    rows.push_back({s.view + " M" + std::to_string(s.mirror + 1) + " " + NameOf(s.error),
                    FormatFixed(s.field_shift_mm, 4), FormatFixed(s.field_shift_px, 2),
                    FormatFixed(s.direction_mrad, 3), FormatFixed(s.roll_mrad, 3),
                    OptionalText(s.stereo_angle_mrad, 3), OptionalText(s.length_error_um, 2),
                    OptionalText(s.strain_error_microstrain, 1)});
  return rows;
}

std::vector<Row> CheckRows(const RigDesign& design) {
  std::vector<Row> rows{{"check", "value", "", "limit", "unit", "verdict"}};
  for (const DesignCheck& check : design.checks)
    rows.push_back({check.what, FormatFixed(check.value, 3), check.at_most ? "<=" : ">=",
                    FormatFixed(check.limit, 3), check.unit, check.ok ? "holds" : "FAILS"});
  return rows;
}

}  // namespace

std::vector<std::string> DesignTables(const OpticalRig& rig, const RigDesign& design) {
  std::vector<std::string> lines;
  lines.push_back("rig: " + rig.title + "; " + FormatFixed(rig.magnification_px_per_mm, 3) +
                  " px/mm, depth of field " + FormatFixed(rig.depth_of_field_mm, 2) +
                  " mm, numerical aperture " + FormatFixed(design.numerical_aperture, 4));
  lines.emplace_back();
  for (const auto& rows :
       {ViewRows(design), MirrorRows(design), LightRows(design), PairRows(design),
        ArrayRows(design), GapRows(design), SensitivityRows(design), CheckRows(design)})
    if (rows.size() > 1) AddTable(lines, rows);
  for (const BlockedLight& light : design.blocked)
    lines.push_back("blocked: " + light.plate + " stands in " + FormatFixed(light.percent, 2) +
                    " % of the rays of " + light.view);
  return lines;
}

}  // namespace telestrain
