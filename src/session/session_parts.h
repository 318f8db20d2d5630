#pragma once

#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "session/session.h"
#include "session/toml_tree.h"

namespace telestrain {

// What parts the entries `<image>#<view>` of corners.vnl; no name of an image or a view may hold
// it.
inline constexpr char kCornerListSigns[] = " \t\n\v\f\r#";

// What is read of a session, from session.toml or from its record.
inline constexpr int kLargestSensor_px = 65536;
inline constexpr int kFewestCorners = 3, kMostCorners = 200;  // of a board, along one side

// The one way from degrees in session.toml to a session: writing looks for degrees that come back.
constexpr double RadiansOf(double degrees) { return degrees * std::numbers::pi / 180.0; }

// The parts of reading a session, in the order in which they run. Private to the module.

// A [[view]] as written: its geometry by vectors, by mirrors, or both.
struct ViewEntry {
  const TomlNode* node = nullptr;
  std::string name, group;
  PixelRegion region;
  std::optional<Eigen::Vector3d> image_x, image_y, axis, center_mm;
  std::optional<std::vector<Mirror>> mirrors;
};

// session.toml into everything of a session that is not in a table.
Result<Session> ReadSessionToml(const std::filesystem::path& path);

// Fills and checks session.views; sensor, lens and camera are there already.
Result<ViewEntry> ReadViewEntry(const TomlNode& node);
Status AddViews(const TomlNode& root, const std::vector<ViewEntry>& entries, Session& session);

// image_x and image_y orthogonal and `axis` parallel to their cross product within 2 degrees, with
// either sign: a mirrored view has the other one. `node` is where an error points.
Status CheckAxes(const TomlNode& node, const Eigen::Vector3d& image_x,
                 const Eigen::Vector3d& image_y, const Eigen::Vector3d& axis);

// calibration.csv, ruler.csv and pipe.csv of session.folder, and that their images are there.
Status ReadTables(Session& session);

}  // namespace telestrain
