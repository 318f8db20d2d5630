#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <regex>

#include "base/files.h"
#include "base/numbers.h"
#include "session/inside_folder.h"
#include "session/session_parts.h"
#include "session/toml_fields.h"

namespace telestrain {
namespace {

constexpr char kSchema[] = "telestrain.session/1";
constexpr double kLargestLength_mm = 1e5;
constexpr double kLongestRuler_mm = 2000;  // more is a number in µm
constexpr double kLargestUncertainty_um = 1e4;
constexpr double kSmallestStageZ = 0.5;  // cosine of 60 degrees

Status CheckSchema(const TomlNode& root) {
  const TomlNode* schema = root.Find("schema");
  if (!schema)
    return BadInput(root.place +
                    "the key 'schema' is missing in the file; begin it with schema = '" + kSchema +
                    "'");
  if (schema->kind == TomlNode::Kind::kText && schema->text == kSchema) return {};
  return BadInput(schema->place + "schema is " + schema->Shown() + ", wanted '" + kSchema +
                  "'; convert the session or use a version of telestrain that reads it");
}

FieldReader SensorTable(SensorSpec& sensor) {
  return Table({Required("width_px", Whole(sensor.width_px, From(1, kLargestSensor_px))),
                Required("height_px", Whole(sensor.height_px, From(1, kLargestSensor_px))),
                Required("pixel_pitch_um", Number(sensor.pixel_pitch_um, Above(0, 1000)))});
}

FieldReader LensTable(Session& session) {
  return Table({Required("magnification", Number(session.lens_magnification, Above(0, 1000))),
                Required("depth_of_field_mm", Number(session.depth_of_field_mm, Above(0, 1e4)))});
}

FieldReader CameraTable(std::optional<PhysicalCamera>& camera) {
  return {"a table", [&camera](const TomlNode& node) -> Status {
            PhysicalCamera read;
            const auto table = Table({Required("position_mm", Point(read.position_mm)),
                                      Required("axis", Direction(read.axis)),
                                      Required("image_x", Direction(read.image_x)),
                                      Required("image_y", Direction(read.image_y))});
            TELESTRAIN_RETURN_IF_ERROR(table.read(node));
            TELESTRAIN_RETURN_IF_ERROR(CheckAxes(node, read.image_x, read.image_y, read.axis));
            camera = read;
            return {};
          }};
}

// The target's normal is the array's z within the poses' tilt; a travel across it would leave the
// depth of every view, and with it the sense of the stage, open.
FieldReader StageAxis(Eigen::Vector3d& axis) {
  const FieldReader direction = Direction(axis);
  return {direction.wanted, [&axis, direction](const TomlNode& node) -> Status {
            TELESTRAIN_RETURN_IF_ERROR(direction.read(node));
            const double from_z_deg =
                std::acos(std::min(std::abs(axis.z()), 1.0)) * 180.0 / std::numbers::pi;
            if (std::abs(axis.z()) >= kSmallestStageZ) return {};
            return BadInput(node.place + node.path + " is " + FormatFixed(from_z_deg, 1) +
                            " deg away from the array's z (either sign), the limit is 60; the "
                            "travel has to be along the target's normal: turn the stage or correct "
                            "the vector");
          }};
}

FieldReader StageTable(Session& session) {
  return Table({Optional("axis_in_array", StageAxis(session.stage_axis_in_array)),
                Optional("sigma_mm", Number(session.stage_sigma_mm, Above(0, 10)))});
}

Status ReadBoard(const TomlNode& node, TargetSpec& target) {
  SubBoard board;
  double rotation_deg = 0;
  TELESTRAIN_RETURN_IF_ERROR(
      ReadFields(node, {Required("group", Text(board.group)),
                        Required("center_in_target_mm", Point(board.center_in_target_mm)),
                        Optional("rotation_deg", Number(rotation_deg, From(-360, 360)))}));
  if (target.FindBoard(board.group))
    return BadInput(node.place + "group '" + board.group +
                    "' has two boards in [target]; keep one board per group");
  board.rotation_rad = RadiansOf(rotation_deg);
  target.boards.push_back(board);
  return {};
}

FieldReader TargetTable(TargetSpec& target) {
  const auto uncertainty = From(0, kLargestUncertainty_um);
  const auto corners = From(kFewestCorners, kMostCorners);
  return Table({Required("columns", Whole(target.columns, corners)),
                Required("rows", Whole(target.rows, corners)),
                Required("square_mm", Number(target.square_mm, Above(0, 1000))),
                Optional("sigma_square_um", Number(target.sigma_square_um, uncertainty)),
                Optional("sigma_separation_um", Number(target.sigma_separation_um, uncertainty)),
                Optional("coplanarity_um", Number(target.coplanarity_um, uncertainty)),
                Optional("flatness_um", Number(target.flatness_um, uncertainty)),
                Required("board", Tables("[[target.board]]", [&target](const auto& node) {
                           return ReadBoard(node, target);
                         }))});
}

FieldReader RulerTable(RulerSpec& ruler) {
  return Table({Required("length_mm", Number(ruler.length_mm, Above(0, kLongestRuler_mm))),
                Optional("sigma_length_um",
                         Number(ruler.sigma_length_um, From(0, kLargestUncertainty_um)))});
}

Status ReadGauge(const TomlNode& node, PipeSpec& pipe) {
  PipeGauge gauge;
  double angle_deg = 0, sigma_angle_deg = 0;
  int reads = 0;
  TELESTRAIN_RETURN_IF_ERROR(ReadFields(
      node,
      {Required("column", Text(gauge.column)),
       Required("axial_mm", Number(gauge.axial_mm, From(-kLargestLength_mm, kLargestLength_mm))),
       Required("angle_deg", Number(angle_deg, From(-360, 360))),
       Optional("length_mm", Number(gauge.length_mm, From(0, kLargestLength_mm))),
       Optional("sigma_microstrain", Number(gauge.sigma_microstrain, From(0, 1e6))),
       Optional("sigma_angle_deg", Number(sigma_angle_deg, From(0, 180))),
       Optional("reads", OneOf(reads, {"mechanical", "apparent"}))}));
  for (const PipeGauge& other : pipe.gauges)
    if (other.column == gauge.column)
      return BadInput(node.place + "column '" + gauge.column +
                      "' has two [[pipe.gauge]]; keep one per column");
  gauge.angle_rad = RadiansOf(angle_deg);
  gauge.sigma_angle_rad = RadiansOf(sigma_angle_deg);
  gauge.reads_thermal_strain = reads == 1;
  pipe.gauges.push_back(gauge);
  return {};
}

FieldReader PipeTable(PipeSpec& pipe) {
  const auto expansion = From(-1e-2, 1e-2);
  return Table(
      {Required("outer_diameter_mm", Number(pipe.outer_diameter_mm, Above(0, kLargestLength_mm))),
       Required("poisson_ratio", Number(pipe.poisson_ratio, From(-1, 0.5))),
       Optional("material", Text(pipe.material)),
       Optional("thermal_expansion_per_k", Number(pipe.thermal_expansion_per_k, expansion)),
       Optional("sigma_thermal_expansion_per_k",
                Number(pipe.sigma_thermal_expansion_per_k, From(0, 1e-2))),
       Optional("sigma_temperature_k", Number(pipe.sigma_temperature_k, From(0, 1000))),
       Optional("gauge", Tables("[[pipe.gauge]]",
                                [&pipe](const auto& node) { return ReadGauge(node, pipe); })),
       Optional("sigma_gauge_microstrain", Number(pipe.sigma_gauge_microstrain, Above(0, 1e4)))});
}

FieldReader AcceptanceTable(AcceptanceSpec& acceptance) {
  return {"a table", [&acceptance](const TomlNode& node) -> Status {
            int rule = 0;
            const auto limit = Above(0, 1e6);
            const auto table = Table(
                {Optional("reprojection_rms_px", Number(acceptance.reprojection_rms_px, limit)),
                 Optional("ruler_mpe_um", Number(acceptance.ruler_mpe_um, limit)),
                 Optional("strain_error_microstrain",
                          Number(acceptance.strain_error_microstrain, limit)),
                 Optional("coverage_factor", Number(acceptance.coverage_factor, Above(0, 10))),
                 Optional("decision_rule", OneOf(rule, {"guarded", "simple"}))});
            TELESTRAIN_RETURN_IF_ERROR(table.read(node));
            acceptance.decision_rule = rule == 0 ? DecisionRule::kGuarded : DecisionRule::kSimple;
            return {};
          }};
}

// Keys of [document] that other programs read as a date.
bool IsDateKey(const std::string& key) {
  return key == "date" || key == "issued" || key == "measured" || key == "measured_from" ||
         key == "measured_to" || key == "received";
}

// "2026-01-17", ISO 8601, and a time if it likes; the month has to have such a day.
bool IsIsoDate(const std::string& text) {
  constexpr std::size_t kLongest = 40;  // std::regex calls itself for every character
  if (text.size() > kLongest) return false;
  static const std::regex kDate("([0-9]{4})-([0-9]{2})-([0-9]{2})([T ][0-9:.Z+-]+)?");
  std::smatch parts;
  if (!std::regex_match(text, parts, kDate)) return false;
  return std::chrono::year_month_day(std::chrono::year(std::stoi(parts[1])),
                                     std::chrono::month(static_cast<unsigned>(std::stoi(parts[2]))),
                                     std::chrono::day(static_cast<unsigned>(std::stoi(parts[3]))))
      .ok();
}

// Free keys; scalars become text as they are written.
FieldReader DocumentTable(std::map<std::string, std::string>& document) {
  return {"a table", [&document](const TomlNode& node) -> Status {
            if (node.kind != TomlNode::Kind::kTable) return WrongValue(node, "a table [document]");
            for (const TomlNode& entry : node.children) {
              if (entry.kind == TomlNode::Kind::kTable || entry.kind == TomlNode::Kind::kArray)
                return WrongValue(entry, "a text, number, truth value or date");
              if (!IsDocumentEntry(entry.key, entry.text))
                return WrongValue(entry, "a date after ISO 8601 such as \"2026-01-17\"");
              document[entry.key] = entry.text;
            }
            return {};
          }};
}

Status CheckBoards(const TomlNode& root, const std::vector<ViewEntry>& entries,
                   const TargetSpec& target) {
  if (target.boards.empty())
    return BadInput(root.Find("target")->place +
                    "[target] has no board; add one [[target.board]] per group");
  for (const ViewEntry& entry : entries) {
    if (target.FindBoard(entry.group)) continue;
    std::vector<std::string> groups;
    for (const SubBoard& board : target.boards) groups.push_back(board.group);
    return BadInput(entry.node->Find("group")->place + "group '" + entry.group + "' of view '" +
                    entry.name + "' has no board in [target] (nearest: '" +
                    NearestWord(entry.group, groups) +
                    "'); add a [[target.board]] for it or correct the group");
  }
  return {};
}

}  // namespace

bool IsDocumentEntry(const std::string& key, const std::string& text) {
  return !IsDateKey(key) || text.empty() || IsIsoDate(text);
}

Result<Session> ReadSessionToml(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code))
    return BadInput(path.string() + ": does not exist; give a session folder, which holds a " +
                    "session.toml, a calibration.csv and the images");
  TELESTRAIN_RETURN_IF_ERROR(StaysInside(path));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMostTextBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(const TomlNode root, ParseToml(path.string(), text));
  TELESTRAIN_RETURN_IF_ERROR(CheckSchema(root));
  Session session;
  session.folder = path.parent_path();
  std::string schema;
  std::vector<ViewEntry> entries;
  const auto add_view = [&entries](const TomlNode& node) -> Status {
    TELESTRAIN_ASSIGN_OR_RETURN(entries.emplace_back(), ReadViewEntry(node));
    return {};
  };
  TELESTRAIN_RETURN_IF_ERROR(ReadFields(
      root,
      {Required("schema", Text(schema)), Required("title", Text(session.title)),
       Required("sensor", SensorTable(session.sensor)), Required("lens", LensTable(session)),
       Optional("camera", CameraTable(session.camera)),
       Required("view", Tables("[[view]]", add_view)), Optional("stage", StageTable(session)),
       Required("target", TargetTable(session.target)),
       Optional("ruler", RulerTable(session.ruler)), Optional("pipe", PipeTable(session.pipe)),
       Optional("acceptance", AcceptanceTable(session.acceptance)),
       Optional("document", DocumentTable(session.document))}));
  TELESTRAIN_RETURN_IF_ERROR(AddViews(root, entries, session));
  TELESTRAIN_RETURN_IF_ERROR(CheckBoards(root, entries, session.target));
  return session;
}

}  // namespace telestrain
