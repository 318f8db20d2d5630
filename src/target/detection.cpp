#include "target/detection.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/csv.h"
#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "base/parallel.h"
#include "target/corners_file.h"
#include "target/image_file.h"
#include "target/target_detector.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kCovarianceFile = "corner_covariances.csv";

// Runs `detect(image, view)` for all views of one file; one result per view in `results`.
template <typename Observation, typename Detect>
Status SearchImage(const Session& session, const std::string& file, Detect detect,
                   Observation* results) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const GrayImage image,
      ReadGrayImage(session.folder / file, session.sensor.width_px, session.sensor.height_px));
  for (std::size_t v = 0; v < session.views.size(); ++v) {
    results[v] = detect(image, session.views[v]);
    results[v].image = file;
    results[v].view = session.views[v].name;
  }
  return {};
}

std::string CovariancesCsv(const Session& session, const std::vector<BoardObservation>& boards) {
  std::string text = "image,view,column,row,cov_uu_px2,cov_uv_px2,cov_vv_px2\n";
  for (const BoardObservation& board : boards)
    for (std::size_t i = 0; i < board.corners.size(); ++i) {
      if (!board.corners[i]) continue;
      const Eigen::Matrix2d& c = board.corners[i]->covariance_px2;
      const int corner = static_cast<int>(i);
      text += CsvLine({board.image, board.view, std::to_string(corner % session.target.columns),
                       std::to_string(corner / session.target.columns), FormatShortest(c(0, 0)),
                       FormatShortest(c(0, 1)), FormatShortest(c(1, 1))});
    }
  return text;
}

Json DetectionJson(const Detection& detection, const std::map<std::string, std::string>& from) {
  Json boards = Json::array();
  for (const BoardObservation& board : detection.boards) {
    const auto seen = std::count_if(board.corners.begin(), board.corners.end(),
                                    [](const auto& corner) { return corner.has_value(); });
    boards.push_back({{"image", board.image},
                      {"view", board.view},
                      {"found", board.rejected_because.empty()},
                      {"corners", seen},
                      {"rejected_because", board.rejected_because}});
  }
  Json crosses = Json::array();
  for (const CrossObservation& cross : detection.crosses) {
    Json item{{"image", cross.image}, {"view", cross.view}};
    if (cross.center) {
      const Eigen::Matrix2d& c = cross.center->covariance_px2;
      item["pixel"] = {cross.center->pixel.x(), cross.center->pixel.y()};
      item["covariance_px2"] = {c(0, 0), c(0, 1), c(1, 0), c(1, 1)};
    } else {
      item["rejected_because"] = cross.rejected_because;
    }
    crosses.push_back(std::move(item));
  }
  return {
      {"schema", kDetectionSchema}, {"made_from", from}, {"boards", boards}, {"crosses", crosses}};
}

using CornerKey = std::pair<std::string, int>;  // "image#view", corner

Result<std::map<CornerKey, Eigen::Matrix2d>> ReadCovariances(const Session& session,
                                                             const fs::path& path) {
  std::map<CornerKey, Eigen::Matrix2d> covariances;
  std::error_code code;
  if (!fs::exists(path, code))
    return BadInput(path.string() +
                    ": does not exist; run 'telestrain detect' again (for corners "
                    "of another detector: 'telestrain calibrate --corners')");
  TELESTRAIN_ASSIGN_OR_RETURN(const CsvTable table, ReadCsv(path));
  if (table.columns.size() != 7)
    return BadInput(path.string() + ": has " + std::to_string(table.columns.size()) +
                    " columns, 7 wanted; run 'telestrain detect' again");
  for (const CsvTable::Row& row : table.rows) {
    const auto column = ParseInt(row.cells[2]), line = ParseInt(row.cells[3]);
    const auto uu = ParseDouble(row.cells[4]), uv = ParseDouble(row.cells[5]),
               vv = ParseDouble(row.cells[6]);
    const bool is_corner = column && line && *column >= 0 && *column < session.target.columns &&
                           *line >= 0 && *line < session.target.rows;
    if (!is_corner || !uu || !uv || !vv || *uu <= 0 || *uu * *vv <= *uv * *uv)
      return BadInput(path.string() + ":" + std::to_string(row.line) +
                      ": is not a corner with a positive covariance; run 'telestrain detect' "
                      "again");
    Eigen::Matrix2d covariance;
    covariance << *uu, *uv, *uv, *vv;
    covariances[{row.cells[0] + "#" + row.cells[1], *line * session.target.columns + *column}] =
        covariance;
  }
  return covariances;
}

// Why boards were rejected, by "image#view".
Result<std::map<std::string, std::string>> ReadReasons(const fs::path& results) {
  std::map<std::string, std::string> reasons;
  const fs::path path = results / "detection.json";
  TELESTRAIN_ASSIGN_OR_RETURN(const Json json,
                              ReadJson(path, kDetectionSchema, "telestrain detect"));
  try {
    for (const Json& board : json.at("boards"))
      reasons[board.at("image").get<std::string>() + "#" + board.at("view").get<std::string>()] =
          board.at("rejected_because").get<std::string>();
    return reasons;
  } catch (const nlohmann::json::exception& e) {
    return BadInput(path.string() + ": " + JsonProblem(e) + "; run 'telestrain detect' again");
  }
}

// Throws nlohmann::json::exception when a key is missing.
CrossObservation CrossFromJson(const Json& item) {
  CrossObservation cross;
  cross.image = item.at("image").get<std::string>();
  cross.view = item.at("view").get<std::string>();
  cross.rejected_because = item.value("rejected_because", "");
  if (!item.contains("pixel")) return cross;
  ImagePoint point;
  for (int i = 0; i < 2; ++i) point.pixel(i) = item.at("pixel").at(i).get<double>();
  for (int i = 0; i < 4; ++i)
    point.covariance_px2(i / 2, i % 2) = item.at("covariance_px2").at(i).get<double>();
  cross.center = point;
  return cross;
}

// Searches the calibration images if wanted, and the ruler images.
Result<Detection> Search(const Session& session, bool with_boards, Console& console) {
  const std::size_t views = session.views.size();
  const std::size_t boards = with_boards ? session.calibration_images.size() : 0;
  const std::size_t rulers = session.ruler_images.size();
  Detection detection;
  detection.boards.resize(boards * views);
  detection.crosses.resize(rulers * views);
  std::vector<Status> outcomes(boards + rulers);
  std::atomic<int> done{0};
  const int total = static_cast<int>(boards + rulers);
  ParallelFor(total, 0, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    if (i < boards)
      outcomes[i] = SearchImage(
          session, session.calibration_images[i].image,
          [&](const GrayImage& image, const NominalView& view) {
            return DetectBoard(image, SearchForBoard(session, view));
          },
          &detection.boards[i * views]);
    else
      outcomes[i] = SearchImage(
          session, session.ruler_images[i - boards],
          [&](const GrayImage& image, const NominalView& view) {
            return DetectCross(image, SearchForCross(session, view));
          },
          &detection.crosses[(i - boards) * views]);
    console.Progress("detecting", ++done, total);
  });
  for (const Status& outcome : outcomes) TELESTRAIN_RETURN_IF_ERROR(outcome);
  return detection;
}

}  // namespace

Result<Detection> DetectAll(const Session& session, Console& console) {
  return Search(session, true, console);
}

Result<std::vector<CrossObservation>> DetectCrosses(const Session& session, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(Detection detection, Search(session, false, console));
  return std::move(detection.crosses);
}

Status WriteDetection(const Session& session, const Detection& detection, const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string inputs, Sha256HexOfFile(results / "inputs.json"));
  TELESTRAIN_RETURN_IF_ERROR(
      WriteFileAtomically(results / kCovarianceFile, CovariancesCsv(session, detection.boards)));
  TELESTRAIN_RETURN_IF_ERROR(WriteCornersVnl(detection.boards, results / "corners.vnl"));
  return WriteJson(results / "detection.json", DetectionJson(detection, {{"inputs.json", inputs}}));
}

Result<std::vector<BoardObservation>> ReadDetectedBoards(const Session& session,
                                                         const fs::path& results) {
  std::error_code code;
  if (!fs::exists(results / "corners.vnl", code))
    return BadInput((results / "corners.vnl").string() +
                    ": does not exist; run 'telestrain detect' first");
  TELESTRAIN_ASSIGN_OR_RETURN(
      std::vector<BoardObservation> boards,
      ReadCornersVnl(results / "corners.vnl", session.target.CornerCount()));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto covariances,
                              ReadCovariances(session, results / kCovarianceFile));
  TELESTRAIN_ASSIGN_OR_RETURN(auto reasons, ReadReasons(results));
  for (BoardObservation& board : boards) {
    const std::string name = board.image + "#" + board.view;
    if (!board.rejected_because.empty() && !reasons[name].empty())
      board.rejected_because = reasons[name];
    for (std::size_t i = 0; i < board.corners.size(); ++i) {
      if (!board.corners[i]) continue;
      const auto at = covariances.find({name, static_cast<int>(i)});
      if (at == covariances.end())
        return BadInput((results / kCovarianceFile).string() + ": has no line for corner " +
                        std::to_string(i) + " of " + name + "; run 'telestrain detect' again");
      board.corners[i]->covariance_px2 = at->second;
    }
  }
  return boards;
}

Result<std::vector<CrossObservation>> ReadDetectedCrosses(const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const Json json, ReadJson(results / "detection.json", kDetectionSchema, "telestrain detect"));
  try {
    std::vector<CrossObservation> crosses;
    for (const Json& item : json.at("crosses")) crosses.push_back(CrossFromJson(item));
    return crosses;
  } catch (const nlohmann::json::exception& e) {
    return BadInput((results / "detection.json").string() + ": " + JsonProblem(e) +
                    "; run 'telestrain detect' again");
  }
}

}  // namespace telestrain
