#include "optics/rig_sensitivity.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

// A mirror error: which mirror of which path, and its size and kind.
struct Disturbance {
  std::size_t path = 0, mirror = 0;
  MirrorError error = MirrorError::kShift;
  double amount = 0;  // rad or mm
};

// In-plane axis of a turn: within the plane of incidence or across it; any when light falls
// straight.
Eigen::Vector3d TurnAxis(const Eigen::Vector3d& normal, const Eigen::Vector3d& incoming,
                         MirrorError error) {
  Eigen::Vector3d across = normal.cross(incoming);
  if (across.norm() < 1e-9) across = normal.unitOrthogonal();
  across.normalize();
  return error == MirrorError::kTurnAcross ? across : Eigen::Vector3d(across.cross(normal));
}

// The ray that reaches a mirror: of the field's middle, from the camera through the mirrors before.
PhysicalCamera MiddleRayBefore(const OpticalRig& rig, const OpticalPath& path, std::size_t mirror) {
  PhysicalCamera ray = rig.camera;
  const Eigen::Vector2d middle_mm = path.field_mm.center();
  ray.position_mm += middle_mm.x() * ray.image_x + middle_mm.y() * ray.image_y;
  return ReflectCamera(ray, {path.mirrors.begin(), path.mirrors.begin() + mirror});
}

OpticalRig Disturbed(OpticalRig rig, const Disturbance& what) {
  OpticalPath& path = rig.paths[what.path];
  const PhysicalCamera ray = MiddleRayBefore(rig, path, what.mirror);
  Mirror& mirror = path.mirrors[what.mirror];
  if (mirror.normal.dot(ray.axis) > 0) mirror.normal = -mirror.normal;
  if (what.error == MirrorError::kShift) {
    mirror.point_mm += what.amount * mirror.normal;
    return rig;
  }
  const Eigen::Vector3d axis = TurnAxis(mirror.normal, ray.axis, what.error);
  const double along_mm =
      mirror.normal.dot(mirror.point_mm - ray.position_mm) / mirror.normal.dot(ray.axis);
  mirror.point_mm = ray.position_mm + along_mm * ray.axis;
  mirror.normal = ExpRotation(what.amount * axis) * mirror.normal;
  return rig;
}

// What is compared between a rig and a disturbed one.
struct RigState {
  Eigen::Vector3d middle_mm, axis, image_x;
  double stereo_angle_rad = 0, length_mm = 0;
};

double AngleBetween_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

const OpticalPath* PartnerOf(const OpticalRig& rig, std::size_t index) {
  for (std::size_t i = 0; i < rig.paths.size(); ++i)
    if (i != index && rig.paths[i].group == rig.paths[index].group) return &rig.paths[i];
  return nullptr;
}

// Mean of the views' centres of a group, and how many there are.
std::pair<Eigen::Vector3d, int> CenterOf(const OpticalRig& rig, const std::string& group) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const OpticalPath& path : rig.paths)
    if (path.group == group) sum += path.center_in_array_mm, ++count;
  return {sum / count, count};
}

// Where the group's point is found with the nominal views when the disturbed ones took its image
// (MODEL.md Eq. 13).
Eigen::Vector3d Triangulated(const OpticalRig& nominal, const OpticalRig& disturbed,
                             const std::string& group) {
  const Eigen::Vector3d truth_mm = CenterOf(nominal, group).first;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < nominal.paths.size(); ++i) {
    if (nominal.paths[i].group != group) continue;
    const TelecentricView as_built = ViewOfCamera(VirtualCamera(disturbed, disturbed.paths[i]));
    const TelecentricView as_known = ViewOfCamera(VirtualCamera(nominal, nominal.paths[i]));
    const auto& axes = as_known.axes_in_array;
    normal += axes.transpose() * axes;
    right += axes.transpose() * (as_built.Ideal(truth_mm) - as_known.offset_mm);
  }
  return normal.inverse() * right;
}

bool HasBase(const OpticalRig& rig) {
  const std::string &first = rig.paths.front().group, &last = rig.paths.back().group;
  return first != last && CenterOf(rig, first).second > 1 && CenterOf(rig, last).second > 1;
}

RigState StateOf(const OpticalRig& nominal, const OpticalRig& rig, std::size_t index) {
  const OpticalPath& path = rig.paths[index];
  const PhysicalCamera camera = VirtualCamera(rig, path);
  const Eigen::Vector2d middle_mm = path.field_mm.center();
  RigState state;
  // Focus stays where the path is as long as before.
  const double focus_mm = FocusPath_mm(nominal, nominal.paths[index]);
  state.middle_mm = camera.position_mm + middle_mm.x() * camera.image_x +
                    middle_mm.y() * camera.image_y + focus_mm * camera.axis;
  state.axis = camera.axis;
  state.image_x = camera.image_x;
  if (const OpticalPath* partner = PartnerOf(rig, index))
    state.stereo_angle_rad = AngleBetween_rad(camera.axis, VirtualCamera(rig, *partner).axis);
  if (HasBase(nominal))
    state.length_mm = (Triangulated(nominal, rig, nominal.paths.back().group) -
                       Triangulated(nominal, rig, nominal.paths.front().group))
                          .norm();
  return state;
}

MirrorSensitivity Sensitivity(const OpticalRig& rig, Disturbance what) {
  const RigState plus = StateOf(rig, Disturbed(rig, what), what.path);
  what.amount = -what.amount;
  const RigState minus = StateOf(rig, Disturbed(rig, what), what.path);
  const PhysicalCamera camera = VirtualCamera(rig, rig.paths[what.path]);
  MirrorSensitivity result;
  result.view = rig.paths[what.path].name;
  result.mirror = static_cast<int>(what.mirror);
  result.error = what.error;
  Eigen::Vector3d shift_mm = 0.5 * (plus.middle_mm - minus.middle_mm);
  shift_mm -= shift_mm.dot(camera.axis) * camera.axis;  // along the axis nothing is seen
  result.field_shift_mm = shift_mm.norm();
  result.field_shift_px = result.field_shift_mm * rig.magnification_px_per_mm;
  result.direction_mrad = 500 * AngleBetween_rad(plus.axis, minus.axis);
  result.roll_mrad = 500 * std::abs((plus.image_x - minus.image_x).dot(camera.image_y));
  if (PartnerOf(rig, what.path))
    result.stereo_angle_mrad = 500 * (plus.stereo_angle_rad - minus.stereo_angle_rad);
  if (!HasBase(rig)) return result;
  const double length_error_mm = 0.5 * (plus.length_mm - minus.length_mm);
  result.length_error_um = 1e3 * length_error_mm;
  result.strain_error_microstrain =
      1e6 * length_error_mm /
      (CenterOf(rig, rig.paths.back().group).first - CenterOf(rig, rig.paths.front().group).first)
          .norm();
  return result;
}

}  // namespace

std::vector<MirrorSensitivity> SensitivityOf(const OpticalRig& rig) {
  std::vector<MirrorSensitivity> table;
  for (std::size_t path = 0; path < rig.paths.size(); ++path)
    for (std::size_t mirror = 0; mirror < rig.paths[path].mirrors.size(); ++mirror) {
      table.push_back(Sensitivity(rig, {path, mirror, MirrorError::kTurnInPlane, kMirrorTurn_rad}));
      table.push_back(Sensitivity(rig, {path, mirror, MirrorError::kTurnAcross, kMirrorTurn_rad}));
      table.push_back(Sensitivity(rig, {path, mirror, MirrorError::kShift, kMirrorShift_mm}));
    }
  return table;
}

}  // namespace telestrain
