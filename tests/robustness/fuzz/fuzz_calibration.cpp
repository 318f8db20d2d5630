#include <nlohmann/json.hpp>
#include <sstream>

#include "base/json_file.h"
#include "calibration/calibration_comparison.h"
#include "calibration/calibration_file.h"
#include "calibration/calibration_record.h"
#include "measurement/state_record.h"
#include "report/chart_files.h"
#include "robustness/fuzz/fuzz_target.h"
#include "session/made_from.h"
#include "session/session_record.h"

namespace telestrain::fuzz {
namespace {

const std::set<std::string> kFiles{"inputs.json", "calibration.json", "residuals.csv",
                                   "strain_states.jsonl", "detection.json"};

// The session of inputs.json, as the steps behind `detect` take it.
std::optional<Session> SessionIn(const std::filesystem::path& folder) {
  const auto inputs = ReadJson(folder / "inputs.json", "telestrain.inputs/1", "telestrain detect");
  if (!Succeeds(inputs)) return std::nullopt;
  try {
    return SessionOfRecord(*inputs);
  } catch (const nlohmann::json::exception&) {  // as documented
    return std::nullopt;
  }
}

void TryStates(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto record = ReadStateRecord(line);
    if (!Succeeds(record)) continue;
    const std::string written = StateRecordLine(*record);
    const auto again = ReadStateRecord(written);
    Require(again.ok() && StateRecordLine(*again) == written, "a state reads back equal");
  }
}

// The comparison of a calibration with itself, with the uncertainty of one parameter: each costs as
// much as the reading of the whole file.
void TryComparison(const Session& session, ArrayCalibration array) {
  Eigen::MatrixXd& covariance = array.covariance_of_noise;
  const double variance = covariance.size() > 0 ? covariance(0, 0) : 0;
  covariance.setZero();
  if (covariance.size() > 0) covariance(0, 0) = variance;
  Succeeds(CompareCalibrations(session, array, array));
}

}  // namespace

void FuzzCalibration(std::string_view input) {
  static MemoryFolder folder("calibration_");
  const auto files = FilesIn(input, kFiles);
  folder.Hold(files, kFiles);
  if (const auto at = files.find("strain_states.jsonl"); at != files.end()) TryStates(at->second);
  Succeeds(ReadResiduals(folder.path()));
  Succeeds(RequireConsistent(folder.path(), Step::kMeasure));
  const auto array = ReadArrayCalibration(folder.path() / "calibration.json");
  if (Succeeds(array)) {
    for (std::size_t view = 0; view < array->views.size(); ++view)
      static_cast<void>(array->LensOf(view));
    static_cast<void>(array->Magnification_px_per_mm());
    static_cast<void>(array->ParameterNames());
  }
  const auto session = SessionIn(folder.path());
  if (!session) return;
  if (array.ok()) TryComparison(*session, *array);
  Succeeds(ReadCalibrationRecord(*session, folder.path()));
}

}  // namespace telestrain::fuzz
