#include "session/session_rig.h"

#include <algorithm>

#include "session/session_parts.h"

namespace telestrain {
namespace {

// Along the array's x, over the corners of all boards in the nominal pose and over the ruler.
double NeededField_mm(const Session& session) {
  Eigen::AlignedBox1d along;
  for (const SubBoard& board : session.target.boards) {
    const Eigen::Matrix3Xd corners_mm = session.target.CornersInTarget(board);
    along.extend(Eigen::Matrix<double, 1, 1>(corners_mm.row(0).minCoeff()));
    along.extend(Eigen::Matrix<double, 1, 1>(corners_mm.row(0).maxCoeff()));
  }
  return std::max(along.isEmpty() ? 0.0 : along.sizes().value(), session.ruler.length_mm);
}

OpticalPath PathOf(const Session& session, const NominalView& view) {
  const double px_per_mm = session.NominalMagnification_px_per_mm();
  const Eigen::Vector2d half_px(0.5 * view.region.width, 0.5 * view.region.height);
  const Eigen::Vector2d middle_px = view.region.Middle() - session.sensor.Middle();
  OpticalPath path;
  path.name = view.name;
  path.group = view.group;
  path.mirrors = view.mirrors;
  path.field_mm = Eigen::AlignedBox2d(Eigen::Vector2d((middle_px - half_px) / px_per_mm),
                                      Eigen::Vector2d((middle_px + half_px) / px_per_mm));
  path.center_in_array_mm = view.center_in_array_mm;
  return path;
}

}  // namespace

Result<OpticalRig> RigOfSession(const Session& session) {
  OpticalRig rig;
  for (const NominalView& view : session.views) {
    if (!view.mirrors.empty()) continue;
    return BadInput(
        "view '" + view.name +
        "' is not given by mirrors, so there is no path to trace; add to every [[view]] "
        "mirrors = [{ point_mm = [x, y, z], normal = [x, y, z] }, ..] in the order of "
        "the light from the lens, and a table [camera] with position_mm, axis, image_x "
        "and image_y ('telestrain simulate --mirrors true' writes an example)");
  }
  if (!session.camera)
    return BadInput(
        "the session has no [camera]; add one with position_mm, axis, image_x, image_y");
  rig.title = session.title;
  rig.camera = *session.camera;
  rig.magnification_px_per_mm = session.NominalMagnification_px_per_mm();
  rig.depth_of_field_mm = session.depth_of_field_mm;
  for (const NominalView& view : session.views) rig.paths.push_back(PathOf(session, view));
  if (session.pipe.outer_diameter_mm > 0) rig.pipe_diameter_mm = session.pipe.outer_diameter_mm;
  if (const double needed_mm = NeededField_mm(session); needed_mm > 0)
    rig.needed_field_mm = needed_mm;
  return rig;
}

Result<OpticalRig> ReadRig(const std::filesystem::path& session_or_file) {
  std::error_code code;
  const bool is_folder = std::filesystem::is_directory(session_or_file, code);
  const auto path = is_folder ? session_or_file / "session.toml" : session_or_file;
  TELESTRAIN_ASSIGN_OR_RETURN(const Session session, ReadSessionToml(path));
  auto rig = RigOfSession(session);
  if (!rig) return BadInput(path.string() + ": " + rig.error().message);
  return rig;
}

}  // namespace telestrain
