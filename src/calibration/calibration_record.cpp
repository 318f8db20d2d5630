#include "calibration/calibration_record.h"

#include <Eigen/LU>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/csv.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "calibration/calibration_file.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

enum Column { kImage, kView, kColumn, kRow, kU, kV, kDu, kDv, kUu, kUv, kVv, kColumns };

Error Unfit(const fs::path& path, const std::string& what) {
  return BadInput(path.string() + ": " + what + "; run 'telestrain calibrate' again");
}

// One corner of the table into its board.
Status AddCorner(const fs::path& path, const CsvTable::Row& row, const TargetSpec& target,
                 BoardObservation& board) {
  const auto column = ParseInt(row.cells[kColumn]), line = ParseInt(row.cells[kRow]);
  std::array<std::optional<double>, kColumns> numbers;
  bool complete = column && line && *column >= 0 && *line >= 0 && *column < target.columns &&
                  *line < target.rows;
  for (int i = kU; i < kColumns; ++i) {
    const auto at = static_cast<std::size_t>(i);
    numbers[at] = ParseDouble(row.cells[at]);
    complete = complete && numbers[at].has_value();
  }
  if (!complete)
    return Unfit(path, "line " + std::to_string(row.line) + " is no corner of the target");
  ImagePoint point;
  point.pixel = {*numbers[kU], *numbers[kV]};
  point.covariance_px2 << *numbers[kUu], *numbers[kUv], *numbers[kUv], *numbers[kVv];
  if (!(point.covariance_px2(0, 0) > 0 && point.covariance_px2.determinant() > 0))
    return Unfit(path, "line " + std::to_string(row.line) + " has no positive covariance");
  board.corners[static_cast<std::size_t>(*line * target.columns + *column)] = point;
  return {};
}

Result<std::vector<BoardObservation>> ReadBoards(const TargetSpec& target, const fs::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const CsvTable table, ReadCsv(path));
  std::string columns;
  for (const std::string& name : table.columns) columns += (columns.empty() ? "" : ",") + name;
  if (columns != kResidualColumns)
    return Unfit(path, "has the columns " + columns + ", wanted " + kResidualColumns);
  std::vector<BoardObservation> boards;
  std::map<std::pair<std::string, std::string>, std::size_t> index;
  for (const CsvTable::Row& row : table.rows) {
    const auto [at, is_new] =
        index.try_emplace({row.cells[kImage], row.cells[kView]}, boards.size());
    if (is_new) {
      boards.push_back({row.cells[kImage], row.cells[kView], {}, "", 0});
      boards.back().corners.resize(static_cast<std::size_t>(target.CornerCount()));
    }
    TELESTRAIN_RETURN_IF_ERROR(AddCorner(path, row, target, boards[at->second]));
  }
  return boards;
}

// The functions below throw nlohmann::json::exception when a key is missing.
TargetPose PoseOf(const Json& json) {
  TargetPose pose;
  for (int i = 0; i < 9; ++i)
    pose.array_from_target(i / 3, i % 3) =
        json.at("rotation_array_from_target").at(i).get<double>();
  for (int i = 0; i < 3; ++i)
    pose.origin_in_array_mm(i) = json.at("origin_in_array_mm").at(i).get<double>();
  return pose;
}

TargetShape ShapeOf(const Json& json) {
  TargetShape shape;
  for (const Json& board : json.at("boards")) {
    BoardShape& of_board = shape.boards.emplace_back();
    of_board.bow_x_mm = board.at("bow_x_um").get<double>() / 1000;
    of_board.bow_y_mm = board.at("bow_y_um").get<double>() / 1000;
  }
  return shape;
}

void ReadSolution(const Session& session, const Json& json, CalibrationRecord& record) {
  record.state.target = ShapeOf(json.at("target"));
  record.state.stage_axis_in_array = session.stage_axis_in_array;
  const Json& stage = json.at("stage_decision");
  if (!stage.at("axis_in_array").is_null()) {
    for (int i = 0; i < 3; ++i)
      record.state.stage_axis_in_array(i) = stage.at("axis_in_array").at(i).get<double>();
    record.state.stage_scale_relative = stage.at("travel_scale_relative").get<double>();
  }
  record.options.model = record.state.array.model;
  record.options.stage_sigma_mm = session.stage_sigma_mm;
  record.options.estimate_bow = json.at("target").at("bow_is_estimated").get<bool>();
  record.options.robust_sigmas = json.at("solver").at("robust_sigmas").get<double>();
  record.data.floor_px = json.at("solver").at("noise_floor_px").get<double>();
  record.noise_is_assumed = json.at("solver").at("corner_noise") == "from the residuals";
  record.sigma0 = json.at("reprojection").at("sigma0").get<double>();
  for (const Json& r : json.at("rejected"))
    record.data.rejected.push_back({r.at("image").get<std::string>(),
                                    r.at("view").get<std::string>(),
                                    r.at("reason").get<std::string>(), r.at("corners").get<int>(),
                                    r.at("whole_board").get<bool>()});
}

// Poses in the order of the images that have corners; false when the two files disagree.
bool ReadPoses(const Json& json, CalibrationRecord& record) {
  const Json& poses = json.at("poses");
  if (poses.size() != record.data.images.size()) return false;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (poses.at(k).at("image") != record.data.images[k].image) return false;
    record.state.poses.push_back(PoseOf(poses.at(k)));
  }
  return json.at("reprojection").at("corners_used") == record.data.CornerCount();
}

}  // namespace

Result<CalibrationRecord> ReadCalibrationRecord(const Session& session, const fs::path& results) {
  const fs::path path = results / "calibration.json";
  CalibrationRecord record;
  TELESTRAIN_ASSIGN_OR_RETURN(record.state.array, ReadArrayCalibration(path));
  TELESTRAIN_ASSIGN_OR_RETURN(const Json json,
                              ReadJson(path, kCalibrationSchema, "telestrain calibrate"));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<BoardObservation> boards,
                              ReadBoards(session.target, results / "residuals.csv"));
  // The noise floor is part of the covariances already.
  TELESTRAIN_ASSIGN_OR_RETURN(record.data, CollectCalibrationData(session, boards, 0));
  try {
    ReadSolution(session, json, record);
    if (!ReadPoses(json, record))
      return Unfit(results / "residuals.csv", "was not made together with calibration.json");
  } catch (const nlohmann::json::exception& e) {
    return Unfit(path, JsonProblem(e));
  }
  return record;
}

}  // namespace telestrain
