#include "diagnostics/interchange.h"

#include <array>
#include <initializer_list>

#include "base/numbers.h"
#include "diagnostics/mrcal_telecentric.h"
#include "geometry/rotation.h"
#include "target/corners_file.h"

namespace telestrain {
namespace {

std::string List(const double* values, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + FormatShortest(values[i]);
  return text;
}

std::string List(std::initializer_list<double> values) {
  return List(values.begin(), values.size());
}

std::string LensModelOf(const std::array<double, 5>& distortion) {
  if (distortion[4] != 0) return "LENSMODEL_OPENCV5";
  return distortion == std::array<double, 5>{} ? "LENSMODEL_PINHOLE" : "LENSMODEL_OPENCV4";
}

std::string IntrinsicsOf(const MrcalCamera& camera) {
  const std::string model = LensModelOf(camera.distortion);
  const std::size_t count = model == "LENSMODEL_PINHOLE" ? 0 : model == "LENSMODEL_OPENCV4" ? 4 : 5;
  std::string text = List(
      {camera.focal_px.x(), camera.focal_px.y(), camera.principal_px.x(), camera.principal_px.y()});
  if (count > 0) text += ", " + List(camera.distortion.data(), count);
  return text;
}

std::string RegionOf(const PixelRegion& region) {
  const auto point = [](int x, int y) {
    return "[ " + std::to_string(x) + ", " + std::to_string(y) + " ], ";
  };
  const int right = region.x + region.width - 1, bottom = region.y + region.height - 1;
  return point(region.x, region.y) + point(right, region.y) + point(right, bottom) +
         point(region.x, bottom) + point(region.x, region.y);
}

std::string Matrix(const std::string& key, const std::string& indent, const Eigen::MatrixXd& m) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = m;
  const std::string inner = "\n" + indent + "   ";
  return indent + key + ": !!opencv-matrix" + inner + "rows: " + std::to_string(m.rows()) + inner +
         "cols: " + std::to_string(m.cols()) + inner + "dt: d" + inner + "data: [ " +
         List(rows.data(), static_cast<std::size_t>(rows.size())) + " ]\n";
}

std::string Scalar(const std::string& key, double value) {
  std::string text = FormatShortest(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".";  // OpenCV's sign of a real number
  return "     " + key + ": " + text + "\n";
}

// Quotes and backslashes as YAML wants them between double quotes.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

constexpr char kOpenCvLegend[] = R"(%YAML:1.0
---
# Calibrated telecentric views, written by telestrain. Lengths are mm on the object, pixel (0, 0) is
# the centre of the first pixel of the whole sensor. For a point P (3x1, mm) of the array's frame:
#   z = depth_sense * (R * P).z + depth_offset_mm
#   (x, y) = ((R * P).xy + t_mm) / (1 + telecentricity_per_mm * z),   r2 = x^2 + y^2
#   x' = x (1 + k1 r2 + k2 r2^2 + k3 r2^3) + 2 p1 x y + p2 (r2 + 2 x^2)
#   y' = y (1 + k1 r2 + k2 r2^2 + k3 r2^3) + p1 (r2 + 2 y^2) + 2 p2 x y
#   pixel = K_px_per_mm * (x', y') + center_px
# There is no division by the depth: the camera is affine. cv::projectPoints is a pinhole and does
# not apply; the .cameramodel files beside this one hold a pinhole at a very large distance.
#   image_width, image_height: of the sensor, px
#   views: in the session's order; of each
#     name, group: the view and the stereo group that it belongs to
#     region_px: x, y, width, height of the view's part of the sensor
#     K_px_per_mm: 2x2, the scales along u and v on the diagonal
#     center_px: 2x1, the pixel of the optical axis, where the distortion has its centre
#     R: 3x3, rotation camera from array; its third row is the direction of the rays up to its sign
#     t_mm: 2x1, where the array's origin is in the image plane; along the rays there is no position
#     distortion: k1, k2, p1, p2, k3 in OpenCV's order, in mm^-2, mm^-4, mm^-1, mm^-1, mm^-6
#     telecentricity_per_mm: relative change of the object side with depth; 0 for parallel rays
#     depth_sense: 1 where the third row of R points away from the camera, else -1
#     depth_offset_mm: depth of the array's origin beyond the plane of unit scale
)";

std::string OpenCvView(const NominalView& nominal, const TelecentricView& view,
                       const TelecentricLens& lens) {
  const std::string indent = "     ";
  const PixelRegion& r = nominal.region;
  const Eigen::Map<const Eigen::Matrix<double, 1, 5>> distortion(lens.distortion.data());
  return "   -\n" + indent + "name: " + Quoted(view.name) + "\n" + indent +
         "group: " + Quoted(view.group) + "\n" + indent + "region_px: [ " + std::to_string(r.x) +
         ", " + std::to_string(r.y) + ", " + std::to_string(r.width) + ", " +
         std::to_string(r.height) + " ]\n" +
         Matrix("K_px_per_mm", indent, Eigen::Matrix2d(lens.Scales_px_per_mm().asDiagonal())) +
         Matrix("center_px", indent, lens.center_px) + Matrix("R", indent, view.Rotation()) +
         Matrix("t_mm", indent, view.offset_mm) + Matrix("distortion", indent, distortion) +
         Scalar("telecentricity_per_mm", lens.telecentricity_per_mm) +
         Scalar("depth_sense", view.depth_sense) + Scalar("depth_offset_mm", view.depth_offset_mm);
}

Status CheckFileName(const std::string& view) {
  if (!view.empty() && view.front() != '.' && view.find_first_of("/\\:") == std::string::npos)
    return {};
  return BadInput("the view '" + view +
                  "' cannot give its name to a file: it holds a slash, a backslash or a colon, or "
                  "starts with a dot; rename it in session.toml and run the steps again");
}

}  // namespace

std::string CameraModelText(const Session& session, const ArrayCalibration& array, int view) {
  const auto index = static_cast<std::size_t>(view);
  const MrcalCamera camera = MrcalCamerasOf(array)[index];
  const Eigen::Vector3d turn = LogRotation(camera.camera_from_reference);
  const Eigen::Vector3d& origin = camera.origin_in_camera_mm;
  const double telecentricity = array.LensOf(index).telecentricity_per_mm;
  std::string text =
      "# View " + array.views[index].name + " of a telecentric array, written by telestrain.\n" +
      "# Its limit as a pinhole: focal length m D at the distance D = " +
      FormatShortest(kMrcalDistance_mm) +
      " mm, distortion k1 D^2, k2 D^4,\n# p1 D, p2 D, k3 D^6. Lengths are mm; the reference is the "
      "array's frame. Depths of some mm change a pixel\n# by 1e-8 px, as parallel rays do not at "
      "all. valid_intrinsics_region is the view's part of the sensor.\n";
  if (telecentricity != 0)
    text += "# Left out: the lens's residual telecentricity, a change of scale of " +
            FormatShortest(telecentricity) + " per mm of depth.\n";
  return text + "{\n    'lensmodel': '" + LensModelOf(camera.distortion) +
         "',\n\n    # intrinsics are fx,fy,cx,cy,distortion0,distortion1,....\n    'intrinsics': "
         "[ " +
         IntrinsicsOf(camera) + " ],\n\n    'valid_intrinsics_region': [ " +
         RegionOf(session.views[index].region) +
         "],\n\n    # extrinsics are rt_fromref\n    'extrinsics': [ " +
         List({turn.x(), turn.y(), turn.z(), origin.x(), origin.y(), origin.z()}) +
         " ],\n\n    'imagersize': [ " + std::to_string(session.sensor.width_px) + ", " +
         std::to_string(session.sensor.height_px) + " ]\n}\n";
}

std::string OpenCvText(const Session& session, const ArrayCalibration& array) {
  std::string text = kOpenCvLegend;
  text += "image_width: " + std::to_string(session.sensor.width_px) +
          "\nimage_height: " + std::to_string(session.sensor.height_px) + "\nviews:\n";
  for (std::size_t v = 0; v < array.views.size(); ++v)
    text += OpenCvView(session.views[v], array.views[v], array.LensOf(v));
  return text;
}

std::string UsedCornersText(const Session& session, const CalibrationData& data) {
  std::vector<BoardObservation> boards;
  for (const BoardData& board : data.boards) {
    BoardObservation& used = boards.emplace_back();
    used.image = data.images[static_cast<std::size_t>(board.image)].image;
    used.view = session.views[static_cast<std::size_t>(board.view)].name;
    used.corners.resize(static_cast<std::size_t>(data.target.CornerCount()));
    for (Eigen::Index i = 0; i < board.Count(); ++i)
      used.corners[static_cast<std::size_t>(board.corner[static_cast<std::size_t>(i)])] =
          ImagePoint{board.pixels.col(i), Eigen::Matrix2d::Identity()};
  }
  return CornersVnlText(boards);
}

Result<std::map<std::string, std::string>> InterchangeFiles(const Session& session,
                                                            const CalibrationRecord& record) {
  std::map<std::string, std::string> files{{"opencv.yaml", OpenCvText(session, record.state.array)},
                                           {"corners.vnl", UsedCornersText(session, record.data)}};
  for (std::size_t v = 0; v < session.views.size(); ++v) {
    TELESTRAIN_RETURN_IF_ERROR(CheckFileName(session.views[v].name));
    files[session.views[v].name + ".cameramodel"] =
        CameraModelText(session, record.state.array, static_cast<int>(v));
  }
  return files;
}

}  // namespace telestrain
