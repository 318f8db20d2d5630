#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "base/numbers.h"
#include "session/session_parts.h"
#include "session/toml_fields.h"

namespace telestrain {
namespace {

constexpr double kAxesTolerance_deg = 2.0;
constexpr double kAgreement_deg = 0.5;
constexpr double kAgreement_mm = 0.05;
constexpr double kSmallestStereoAngle_deg = 5.0;
// A ray flatter than this (1 degree) does not meet the plane z = 0 anywhere near the array.
constexpr double kFlatRaySine = 0.01745;

double Angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

Status CheckRegion(const ViewEntry& entry, const SensorSpec& sensor) {
  const PixelRegion& region = entry.region;
  const bool inside = region.width > 0 && region.height > 0 &&
                      region.x + region.width <= sensor.width_px &&
                      region.y + region.height <= sensor.height_px;
  if (inside) return {};
  const auto text = [](int number) { return std::to_string(number); };
  const TomlNode& node = *entry.node->Find("region_px");
  return BadInput(node.place + node.path + " is [" + text(region.x) + ", " + text(region.y) + ", " +
                  text(region.width) + ", " + text(region.height) + "], wanted [x, y, width, " +
                  "height] with pixels inside the sensor of " + text(sensor.width_px) + " x " +
                  text(sensor.height_px) + "; correct the region or [sensor]");
}

bool Overlap(const PixelRegion& a, const PixelRegion& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

Status CheckPair(const ViewEntry& earlier, const ViewEntry& later) {
  if (earlier.name == later.name)
    return BadInput(later.node->Find("name")->place + "the view name '" + later.name +
                    "' is used twice; give every view its own name");
  if (Overlap(earlier.region, later.region))
    return BadInput(later.node->Find("region_px")->place + "the region of view '" + later.name +
                    "' overlaps that of view '" + earlier.name +
                    "'; a pixel belongs to one view: correct region_px");
  return {};
}

Status CheckName(const ViewEntry& entry) {
  if (entry.name.find_first_of(kCornerListSigns) == std::string::npos) return {};
  return BadInput(entry.node->Find("name")->place + "the view name '" + entry.name +
                  "' holds white space or '#', which the list of corners parts its entries by; "
                  "rename the view, for example with '_'");
}

// Telecentric views along one line, from either side, see the same two coordinates of a point and
// say nothing about the third. `node` is where the later view stands.
Status CheckStereoAngle(const TomlNode& node, const NominalView& earlier,
                        const NominalView& later) {
  if (earlier.group != later.group) return {};
  const double between_deg = Angle_deg(earlier.axis_in_array, later.axis_in_array);
  const double angle_deg = std::min(between_deg, 180 - between_deg);
  if (angle_deg >= kSmallestStereoAngle_deg) return {};
  return BadInput(node.place + "the views '" + earlier.name + "' and '" + later.name +
                  "' of group '" + later.group + "' look along lines " + FormatFixed(angle_deg, 2) +
                  " deg apart, wanted at least 5: a stereo pair needs two directions; correct "
                  "axis_in_array of one of them (with image_x and image_y, or its mirrors) or give "
                  "it another group");
}

// The region's middle as seen by the camera behind its mirrors.
NominalView ViewBehindMirrors(const ViewEntry& entry, const Session& session) {
  const PhysicalCamera camera = ReflectCamera(*session.camera, *entry.mirrors);
  const Eigen::Vector2d ideal_mm =
      (entry.region.Middle() - session.sensor.Middle()) / session.NominalMagnification_px_per_mm();
  const Eigen::Vector3d start_mm =
      camera.position_mm + ideal_mm.x() * camera.image_x + ideal_mm.y() * camera.image_y;
  const bool is_flat = std::abs(camera.axis.z()) < kFlatRaySine;
  const double along_mm = is_flat ? -start_mm.dot(camera.axis) : -start_mm.z() / camera.axis.z();
  NominalView view;
  view.image_x_in_array = camera.image_x;
  view.image_y_in_array = camera.image_y;
  view.axis_in_array = camera.axis;
  view.center_in_array_mm = start_mm + along_mm * camera.axis;
  return view;
}

Error Disagreement(const ViewEntry& entry, const std::string& key, const std::string& found) {
  const TomlNode& node = *entry.node->Find(key);
  return BadInput(node.place + node.path + " and the mirrors of view '" + entry.name +
                  "' disagree by " + found + "; correct one of them or give only one");
}

Status CheckAgreement(const ViewEntry& entry, const NominalView& mirrored) {
  const std::tuple<const char*, std::optional<Eigen::Vector3d>, Eigen::Vector3d> directions[] = {
      {"image_x_in_array", entry.image_x, mirrored.image_x_in_array},
      {"image_y_in_array", entry.image_y, mirrored.image_y_in_array},
      {"axis_in_array", entry.axis, mirrored.axis_in_array}};
  for (const auto& [key, given, computed] : directions) {
    const double angle_deg = given ? Angle_deg(*given, computed) : 0;
    if (angle_deg > kAgreement_deg)
      return Disagreement(entry, key, FormatFixed(angle_deg, 2) + " deg, limit 0.5 deg");
  }
  if (!entry.center_mm) return {};
  const Eigen::Vector3d shift = *entry.center_mm - mirrored.center_in_array_mm;
  const double across_mm = shift.cross(mirrored.axis_in_array).norm();
  if (across_mm > kAgreement_mm)
    return Disagreement(entry, "center_in_array_mm",
                        FormatFixed(across_mm, 3) + " mm across the axis, limit 0.05 mm");
  return {};
}

Status CheckGeometryGiven(const ViewEntry& entry, const Session& session) {
  if (entry.mirrors && !session.camera)
    return BadInput(entry.node->Find("mirrors")->place + "view '" + entry.name +
                    "' is given by mirrors, but the file has no [camera]; add [camera] with "
                    "position_mm, axis, image_x and image_y");
  if (entry.mirrors) return {};
  const std::pair<const char*, bool> keys[] = {{"image_x_in_array", entry.image_x.has_value()},
                                               {"image_y_in_array", entry.image_y.has_value()},
                                               {"axis_in_array", entry.axis.has_value()},
                                               {"center_in_array_mm", entry.center_mm.has_value()}};
  for (const auto& [key, given] : keys)
    if (!given)
      return BadInput(entry.node->place + "the key '" + key + "' is missing in view '" +
                      entry.name + "'; add it, or give mirrors and [camera] instead");
  return {};
}

Result<NominalView> MakeView(const ViewEntry& entry, const Session& session) {
  TELESTRAIN_RETURN_IF_ERROR(CheckGeometryGiven(entry, session));
  NominalView view;
  if (entry.mirrors) {
    view = ViewBehindMirrors(entry, session);
    TELESTRAIN_RETURN_IF_ERROR(CheckAgreement(entry, view));
    view.mirrors = *entry.mirrors;
  }
  view.name = entry.name;
  view.group = entry.group;
  view.region = entry.region;
  view.image_x_in_array = entry.image_x.value_or(view.image_x_in_array);
  view.image_y_in_array = entry.image_y.value_or(view.image_y_in_array);
  view.axis_in_array = entry.axis.value_or(view.axis_in_array);
  view.center_in_array_mm = entry.center_mm.value_or(view.center_in_array_mm);
  TELESTRAIN_RETURN_IF_ERROR(
      CheckAxes(*entry.node, view.image_x_in_array, view.image_y_in_array, view.axis_in_array));
  return view;
}

Status ReadMirror(const TomlNode& node, std::vector<Mirror>& mirrors) {
  Mirror& mirror = mirrors.emplace_back();
  return ReadFields(node, {Required("point_mm", Point(mirror.point_mm)),
                           Required("normal", Direction(mirror.normal))});
}

}  // namespace

Status CheckAxes(const TomlNode& node, const Eigen::Vector3d& image_x,
                 const Eigen::Vector3d& image_y, const Eigen::Vector3d& axis) {
  const double between_deg = Angle_deg(image_x, image_y);
  if (std::abs(between_deg - 90) > kAxesTolerance_deg)
    return BadInput(node.place + "image_x and image_y of " + node.path + " enclose " +
                    FormatFixed(between_deg, 2) +
                    " deg, wanted 90 within 2; correct one of the vectors");
  const double to_normal_deg = Angle_deg(image_x.cross(image_y), axis);
  const double off_deg = std::min(to_normal_deg, 180 - to_normal_deg);
  if (off_deg > kAxesTolerance_deg)
    return BadInput(node.place + "the axis of " + node.path + " is " + FormatFixed(off_deg, 2) +
                    " deg away from image_x × image_y (either sign), the limit is 2; correct one "
                    "of the vectors");
  return {};
}

Result<ViewEntry> ReadViewEntry(const TomlNode& node) {
  ViewEntry entry;
  entry.node = &node;
  Eigen::Vector4i region;
  std::vector<Mirror> mirrors;
  const auto add_mirror = [&mirrors](const TomlNode& item) { return ReadMirror(item, mirrors); };
  TELESTRAIN_RETURN_IF_ERROR(ReadFields(
      node,
      {Required("name", Text(entry.name)), Required("group", Text(entry.group)),
       Required("region_px", Wholes4(region, From(0, kLargestSensor_px))),
       Optional("image_x_in_array", Direction(entry.image_x)),
       Optional("image_y_in_array", Direction(entry.image_y)),
       Optional("axis_in_array", Direction(entry.axis)),
       Optional("center_in_array_mm", Point(entry.center_mm)),
       Optional("mirrors", Tables("{ point_mm = [x, y, z], normal = [x, y, z] }", add_mirror))}));
  entry.region = {region[0], region[1], region[2], region[3]};
  if (!mirrors.empty()) entry.mirrors = mirrors;
  return entry;
}

Status AddViews(const TomlNode& root, const std::vector<ViewEntry>& entries, Session& session) {
  if (entries.empty())
    return BadInput(root.Find("view")->place +
                    "'view' has no entry; describe every virtual camera by one [[view]]");
  constexpr std::size_t kMostViews = 16;  // both branches of every view are tried together
  if (entries.size() > kMostViews)
    return BadInput(root.Find("view")->place + "'view' has " + std::to_string(entries.size()) +
                    " entries, at most " + std::to_string(kMostViews) +
                    " are supported; calibrate the instrument in parts");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    TELESTRAIN_RETURN_IF_ERROR(CheckName(entries[i]));
    TELESTRAIN_RETURN_IF_ERROR(CheckRegion(entries[i], session.sensor));
    for (std::size_t j = 0; j < i; ++j)
      TELESTRAIN_RETURN_IF_ERROR(CheckPair(entries[j], entries[i]));
    TELESTRAIN_ASSIGN_OR_RETURN(const NominalView view, MakeView(entries[i], session));
    for (const NominalView& earlier : session.views)
      TELESTRAIN_RETURN_IF_ERROR(CheckStereoAngle(*entries[i].node, earlier, view));
    session.views.push_back(view);
  }
  return {};
}

}  // namespace telestrain
