#include "session/session.h"

#include <algorithm>
#include <cmath>

#include "geometry/rotation.h"
#include "session/session_parts.h"

namespace telestrain {

Eigen::Matrix3Xd TargetSpec::CornersInTarget(const SubBoard& board) const {
  const double cosine = std::cos(board.rotation_rad), sine = std::sin(board.rotation_rad);
  Eigen::Matrix3Xd corners(3, CornerCount());
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x_mm = (column - 0.5 * (columns - 1)) * square_mm;
      const double y_mm = (row - 0.5 * (rows - 1)) * square_mm;
      const Eigen::Vector3d turned_mm(cosine * x_mm - sine * y_mm, sine * x_mm + cosine * y_mm, 0);
      corners.col(row * columns + column) = board.center_in_target_mm + turned_mm;
    }
  }
  return corners;
}

const SubBoard* TargetSpec::FindBoard(const std::string& group) const {
  const auto at = std::find_if(boards.begin(), boards.end(),
                               [&](const SubBoard& board) { return board.group == group; });
  return at == boards.end() ? nullptr : &*at;
}

TelecentricLens Session::NominalLens() const {
  TelecentricLens lens;
  lens.magnification_px_per_mm = NominalMagnification_px_per_mm();
  lens.center_px = sensor.Middle();
  return lens;
}

TelecentricView Session::NominalTelecentricView(const NominalView& view) const {
  TelecentricView result;
  result.name = view.name;
  result.group = view.group;
  result.axes_in_array =
      RotationFromRows(view.image_x_in_array, view.image_y_in_array).topRows<2>();
  result.offset_mm = NominalLens().IdealFromPixel(view.region.Middle()) -
                     result.axes_in_array * view.center_in_array_mm;
  result.depth_sense = result.RayDirection().dot(view.axis_in_array) < 0 ? -1 : 1;
  result.depth_offset_mm = -result.depth_sense * result.RayDirection().dot(view.center_in_array_mm);
  return result;
}

std::vector<std::string> Session::Groups() const {
  std::vector<std::string> groups;
  for (const NominalView& view : views)
    if (std::find(groups.begin(), groups.end(), view.group) == groups.end())
      groups.push_back(view.group);
  return groups;
}

Result<Session> ReadSession(const std::filesystem::path& folder, bool corners_are_given) {
  TELESTRAIN_ASSIGN_OR_RETURN(Session session, ReadSessionToml(folder / "session.toml"));
  session.folder = folder;
  session.corners_are_given = corners_are_given;
  TELESTRAIN_RETURN_IF_ERROR(ReadTables(session));
  return session;
}

}  // namespace telestrain
