#include "app/steps.h"

#include <nlohmann/json.hpp>

#include "app/results_folder.h"
#include "app/step_record.h"
#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "calibration/calibration_file.h"
#include "measurement/ruler_acceptance.h"
#include "target/corner_import.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Result<StepRecord> OpenRecord(const fs::path& results, const fs::path& corners) {
  TELESTRAIN_ASSIGN_OR_RETURN(std::vector<std::string> files, SessionFiles(results));
  return StepRecord{"open",           {{"corners", corners.string()}}, std::move(files), {},
                    IfGiven(corners), {"inputs.json", "session.toml"}};
}

// Says where the session lies.
Status WritePlace(const fs::path& folder, const fs::path& results) {
  std::error_code code;
  const std::string place = fs::absolute(folder, code).lexically_normal().string() + "\n";
  if (fs::exists(results / "session.path", code))
    if (const auto known = ReadFile(results / "session.path"); known && *known == place) return {};
  return WriteFileAtomically(results / "session.path", place);
}

// Leaves the session's description and its place in the results folder, and records what was read.
Status RecordOpening(const fs::path& folder, const fs::path& results, const fs::path& corners) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string description,
                              ReadFile(folder / "session.toml", kMostTextBytes));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results / "session.toml", description));
  TELESTRAIN_RETURN_IF_ERROR(WritePlace(folder, results));
  TELESTRAIN_ASSIGN_OR_RETURN(const StepRecord record, OpenRecord(results, corners));
  return RecordStep(results, record);
}

// Whether the results were made from these inputs, as inputs.json tells of them.
Result<bool> IsOpen(const fs::path& results, const std::string& inputs, const fs::path& corners) {
  std::error_code code;
  if (!fs::exists(results / "inputs.json", code)) return false;
  const auto known = ReadFile(results / "inputs.json");
  if (!known || *known != inputs) return false;
  TELESTRAIN_ASSIGN_OR_RETURN(const StepRecord record, OpenRecord(results, corners));
  return IsDone(results, record);
}

StepRecord DetectRecord(const Session& session, const fs::path& corners) {
  return {"detect",
          {{"corners", corners.string()}},
          TargetFiles(session),
          {"inputs.json"},
          IfGiven(corners),
          {"corners.vnl", "corner_covariances.csv", "detection.json"}};
}

StepRecord VerifyRecord() {
  return {"verify",
          Json::object(),
          {"session.toml", "ruler.csv"},
          {"detection.json", "calibration.json"},
          {},
          {"ruler.csv", "ruler.json"}};
}

}  // namespace

Result<ArrayCalibration> LoadCalibration(const Session& session, const fs::path& results) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kDiagnose));
  TELESTRAIN_ASSIGN_OR_RETURN(ArrayCalibration array,
                              ReadArrayCalibration(results / "calibration.json"));
  bool same = array.views.size() == session.views.size();
  for (std::size_t i = 0; same && i < array.views.size(); ++i)
    same = array.views[i].name == session.views[i].name;
  if (!same)
    return BadInput((results / "calibration.json").string() +
                    ": has other views than the session; run 'telestrain calibrate' again");
  return array;
}

Result<Session> OpenSession(const fs::path& folder, const fs::path& results,
                            const fs::path& corners, ResultsLock& lock, Earlier earlier) {
  TELESTRAIN_ASSIGN_OR_RETURN(Session session, ReadSession(folder, !corners.empty()));
  std::error_code code;
  if (fs::equivalent(folder, results, code))
    return Error{ErrorKind::kUsage,
                 "--out is the session folder itself; name another folder, the "
                 "recorded session stays as it is"};
  if (!corners.empty() && fs::equivalent(corners, results / "corners.vnl", code))
    return Error{ErrorKind::kUsage,
                 "--corners is the corners.vnl of --out itself, which this step writes anew; copy "
                 "it elsewhere, or leave --corners out to use it as it is"};
  // Bad input must be known before anything in the results folder is touched.
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string inputs, InputsText(session, corners));
  TELESTRAIN_RETURN_IF_ERROR(CheckTrail(results));
  TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(results));
  TELESTRAIN_ASSIGN_OR_RETURN(lock, ResultsLock::Take(results));
  if (earlier == Earlier::kKept) {
    TELESTRAIN_ASSIGN_OR_RETURN(const bool is_open, IsOpen(results, inputs, corners));
    if (is_open) TELESTRAIN_RETURN_IF_ERROR(WritePlace(folder, results));
    if (is_open) return session;
  }
  TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kDetect));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results / "inputs.json", inputs));
  TELESTRAIN_RETURN_IF_ERROR(RecordOpening(folder, results, corners));
  return session;
}

Result<Session> ReopenSession(const fs::path& folder, const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(const bool corners_are_given, CornersWereGiven(results));
  TELESTRAIN_ASSIGN_OR_RETURN(Session session, ReadSession(folder, corners_are_given));
  TELESTRAIN_RETURN_IF_ERROR(RequireSameInputs(session, results));
  TELESTRAIN_RETURN_IF_ERROR(CheckTrail(results));
  return session;
}

Status DetectStep(const Session& session, const fs::path& results, const fs::path& corners,
                  Console& console, Earlier earlier) {
  const StepRecord record = DetectRecord(session, corners);
  if (earlier == Earlier::kKept) {
    TELESTRAIN_ASSIGN_OR_RETURN(const bool kept, IsKept(results, record, console));
    if (kept) return {};
    TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kDetect));
  }
  TELESTRAIN_ASSIGN_OR_RETURN(
      const Detection detection,
      corners.empty() ? DetectAll(session, console) : ImportCorners(session, corners, console));
  TELESTRAIN_RETURN_IF_ERROR(WriteDetection(session, detection, results));
  std::size_t found = 0, crosses = 0;
  for (const BoardObservation& board : detection.boards) found += board.rejected_because.empty();
  for (const CrossObservation& cross : detection.crosses) crosses += cross.center.has_value();
  console.Say("detect     " + std::to_string(found) + " of " +
              CountText(detection.boards.size(), "board view") + " used, " +
              std::to_string(crosses) + " of " + std::to_string(detection.crosses.size()) +
              " ruler crosses");
  for (const BoardObservation& board : detection.boards)
    if (!board.rejected_because.empty())
      console.Note("  not used: " + board.image + " " + board.view + ": " + board.rejected_because);
  return RecordStep(results, record);
}

Status VerifyStep(const Session& session, const fs::path& results, Console& console,
                  Earlier earlier) {
  if (earlier == Earlier::kKept) {
    TELESTRAIN_ASSIGN_OR_RETURN(const bool kept, IsKept(results, VerifyRecord(), console));
    if (kept) return {};
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const ArrayCalibration array, LoadCalibration(session, results));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<CrossObservation> crosses,
                              ReadDetectedCrosses(results));
  TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kVerify));
  if (session.ruler_images.empty()) {
    console.Say("verify     the session has no ruler images");
    return RecordStep(results, VerifyRecord());
  }
  const std::vector<RulerLength> lengths = MeasureRuler(session, array, crosses);
  TELESTRAIN_ASSIGN_OR_RETURN(const auto made_from,
                              HashesOf(results, {"detection.json", "calibration.json"}));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results / "ruler.csv", RulerCsv(lengths)));
  const RulerAcceptance acceptance = AcceptRuler(session, array, lengths);
  auto json = RulerJson(session, lengths, made_from);
  json["acceptance"] = RulerAcceptanceJson(acceptance, lengths, session.acceptance.coverage_factor);
  TELESTRAIN_RETURN_IF_ERROR(WriteJson(results / "ruler.json", json));
  const RulerSummary summary = Summarise(lengths);
  if (summary.count == 0)
    console.Say("verify     none of " + CountText(lengths.size(), "ruler image") +
                " could be measured");
  else
    console.Say("verify     " + CountText(static_cast<std::size_t>(summary.count), "ruler length") +
                ", error mean " + FormatFixed(summary.mean_error_um, 3) + " um, sd " +
                FormatFixed(summary.sd_error_um, 3) + " um, largest " +
                FormatFixed(summary.max_abs_error_um, 3) + " um");
  for (const RulerLength& length : lengths)
    if (!length.rejected_because.empty())
      console.Note("  not used: " + length.image + ": " + length.rejected_because);
  return RecordStep(results, VerifyRecord());
}

}  // namespace telestrain
