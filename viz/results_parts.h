#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "session/session.h"
#include "viz/scene/json_node.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// The parts of reading a results folder into a scene. Private to the module. What takes a JsonNode
// throws BadField.

// Runs `read`. A BadField becomes an error (kBadInput) with the file and `maker`, the command that
// makes it again.
Status ReadFields(const std::filesystem::path& path, const std::string& maker,
                  const std::function<void()>& read);

// What inputs.json, the record of the session, says to a scene.
struct RecordedInputs {
  TargetSpec target;  // no certificate values
  std::vector<PipeGauge> gauges;
  double nominal_radius_mm = 0;  // 0: none
  Eigen::Vector2i sensor_px = Eigen::Vector2i::Zero();
  AcceptanceLimits limits;
  double coverage_factor = 2;
  std::optional<OpticalRig> optics;  // when every view is given by mirrors
};
RecordedInputs InputsOf(const nlohmann::ordered_json& inputs);

// The views of calibration.json into views, view_regions_px, magnification and the RMS.
void AddViews(const JsonNode& calibration, Scene* scene);

// The poses of calibration.json as boards, and what it rejected; after AddViews().
void AddBoards(const JsonNode& calibration, const TargetSpec& target, Scene* scene);

// The positions of ruler.json.
void AddRulers(const JsonNode& ruler, Scene* scene);

// Columns and rows of the cells that the residuals of one view are averaged over.
inline constexpr int kResidualCellColumns = 12, kResidualCellRows = 9;

// The residuals of residuals.csv, averaged over the cells of every view's region of `scene`: view
// by view, row by row, only those that hold corners. Empty when the folder has no such file. Fails
// (kBadInput) with file, line and what was found.
Result<std::vector<ResidualCell>> ResidualCellsOf(const std::filesystem::path& results,
                                                  const Scene& scene);

// The gauges on the cylinder of `pipe` (axis and radius), at their angles about its axis as
// strain.json defines them and at their places along it, counted from the axis' point nearest to
// the array's origin. Of a bent pipe it is the cylinder fitted to it.
std::vector<Gauge> PlaceGauges(const JsonNode& strain, const std::vector<PipeGauge>& gauges,
                               const Pipe& pipe);

// The pipe of strain.json with the surfaces of all states; empty when the folder has no such file.
// The points' groups are below `group_count`. Fails as SceneFromResults() does.
Result<std::optional<Pipe>> PipeFromResults(const std::filesystem::path& results,
                                            const RecordedInputs& inputs, int group_count);

}  // namespace telestrain::viz
