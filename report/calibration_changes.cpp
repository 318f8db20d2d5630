#include "report/calibration_changes.h"

#include <Eigen/Dense>
#include <cmath>

#include "report/result_cells.h"

namespace telestrain {
namespace {

constexpr double kUmPerMm = 1000;
constexpr double kMicroradiansPerRadian = 1e6;

// A view as a telecentric camera without distortion: pixel = scale · (x, y axis) · point + offset.
struct View {
  std::string name;
  Eigen::Matrix3d directions;  // rows: image x, image y, viewing axis, in the array
  Eigen::Vector2d offset_px;
  Eigen::Vector3d middle_mm;  // the object point in the middle of its field
  double scale_px_per_mm = 0;

  Eigen::Vector2d Pixel(const Eigen::Vector3d& point_mm) const {
    return scale_px_per_mm * (directions.topRows<2>() * point_mm) + offset_px;
  }
};

template <typename Vector>
bool ReadVector(const Json& json, const std::string& key, Vector&& vector) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    const auto number = NumberAt(json, "/" + key + "/" + std::to_string(i));
    if (!number) return false;
    vector(i) = *number;
  }
  return true;
}

std::optional<View> ReadView(const Json& calibration, const Json& json) {
  View view;
  view.name = TextAt(json, "/name");
  const auto own = NumberAt(json, "/lens/magnification_px_per_mm"),
             shared = NumberAt(calibration, "/lens/magnification_px_per_mm");
  if (!own && !shared) return {};
  view.scale_px_per_mm = own ? *own : *shared;
  Eigen::Vector3d x, y, axis;
  if (!ReadVector(json, "image_x_in_array", x) || !ReadVector(json, "image_y_in_array", y) ||
      !ReadVector(json, "axis_in_array", axis) || !ReadVector(json, "offset_px", view.offset_px) ||
      !ReadVector(json, "center_in_array_mm", view.middle_mm))
    return {};
  view.directions << x.transpose(), y.transpose(), axis.transpose();
  return view;
}

struct ViewPair {
  View before, after;
};

std::vector<ViewPair> PairsOf(const Json& before, const Json& after) {
  std::vector<ViewPair> pairs;
  for (const Json& json : ListAt(after, "/views")) {
    const auto now = ReadView(after, json);
    const auto then =
        ReadView(before, FindBy(ListAt(before, "/views"), "name", TextAt(json, "/name")));
    if (now && then && now->scale_px_per_mm > 0) pairs.push_back({*then, *now});
  }
  return pairs;
}

// after_from_before of the array's frame by all directions (Kabsch).
Eigen::Matrix3d TurnOf(const std::vector<ViewPair>& pairs) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const ViewPair& pair : pairs)
    sum += pair.after.directions.transpose() * pair.before.directions;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

// How far the middles of the fields moved on the sensor, px, after the best common shift.
std::vector<Eigen::Vector2d> ShiftsOf_px(const std::vector<ViewPair>& pairs,
                                         const Eigen::Matrix3d& turn) {
  const auto rows = static_cast<Eigen::Index>(2 * pairs.size());
  Eigen::MatrixX3d by_shift(rows, 3);
  Eigen::VectorXd moved_px(rows);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    const auto& [before, after] = pairs[i];
    by_shift.middleRows<2>(row) = after.scale_px_per_mm * after.directions.topRows<2>();
    moved_px.segment<2>(row) =
        after.Pixel(turn * before.middle_mm) - before.Pixel(before.middle_mm);
  }
  const Eigen::Vector3d shift_mm =
      -Eigen::MatrixXd(by_shift).completeOrthogonalDecomposition().solve(moved_px);
  moved_px += by_shift * shift_mm;
  std::vector<Eigen::Vector2d> shifts_px;
  for (Eigen::Index row = 0; row < rows; row += 2) shifts_px.push_back(moved_px.segment<2>(row));
  return shifts_px;
}

void AddMagnification(const Json& before, const Json& after,
                      std::vector<CalibrationChange>& changes) {
  const char* kValue = "/lens/magnification_px_per_mm";
  const char* kSigma = "/lens/sigma_magnification_px_per_mm";
  const auto then = NumberAt(before, kValue), now = NumberAt(after, kValue);
  const auto sigma_then = NumberAt(before, kSigma), sigma_now = NumberAt(after, kSigma);
  if (!then || !now) return;
  CalibrationChange change{"magnification", "px/mm", *now - *then, {}};
  if (sigma_then && sigma_now) change.standard_uncertainty = std::hypot(*sigma_then, *sigma_now);
  changes.push_back(change);
}

}  // namespace

std::vector<CalibrationChange> ChangesOfComparison(const Json& comparison) {
  std::vector<CalibrationChange> changes;
  for (const Json& json : ListAt(comparison, "/changes")) {
    const auto value = NumberAt(json, "/value");
    if (!value) continue;
    const std::string unit = TextAt(json, "/unit");
    changes.push_back({PhraseOfText(TextAt(json, "/quantity", "?")),
                       unit == "um"            ? "µm"
                       : unit == "microstrain" ? "µε"
                                               : unit,
                       *value, NumberAt(json, "/standard_uncertainty")});
  }
  return changes;
}

std::vector<CalibrationChange> ChangesOfCalibrations(const Json& before, const Json& after) {
  std::vector<CalibrationChange> changes;
  AddMagnification(before, after, changes);
  const std::vector<ViewPair> pairs = PairsOf(before, after);
  if (pairs.empty()) return changes;
  const Eigen::Matrix3d turn = TurnOf(pairs);
  const std::vector<Eigen::Vector2d> shifts_px = ShiftsOf_px(pairs, turn);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const View& then = pairs[i].before;
    const View& now = pairs[i].after;
    const auto add = [&](const char* pattern, const char* unit, double value) {
      changes.push_back({Phrase(pattern, {{"view", now.name}}), unit, value, {}});
    };
    const Eigen::Vector3d axis_then = turn * then.directions.row(2).transpose();
    const Eigen::Vector3d axis_now = now.directions.row(2).transpose();
    const double angle_rad = std::atan2(axis_then.cross(axis_now).norm(), axis_then.dot(axis_now));
    const Eigen::Vector2d shift_um = kUmPerMm / now.scale_px_per_mm * shifts_px[i];
    add("direction of {{view}}", "µrad", kMicroradiansPerRadian * angle_rad);
    add("shift of the field of {{view}} along u", "µm", shift_um.x());
    add("shift of the field of {{view}} along v", "µm", shift_um.y());
  }
  return changes;
}

}  // namespace telestrain
