#include "study/image_experiment.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "base/numbers.h"
#include "simulation/load_plan.h"
#include "simulation/nominal_session.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// What a virtual session consists of.
bool IsPartOfSession(const fs::path& path) {
  constexpr std::array kNames{"session.toml", "calibration.csv", "ruler.csv", "pipe.csv",
                              "calibration",  "ruler",           "pipe"};
  return std::find(kNames.begin(), kNames.end(), path.filename().string()) != kNames.end();
}

// Removes the session that an earlier study left: one whose truth lies beside it, which no recorded
// session has. The folder itself stays.
Status ClearSession(const fs::path& folder, const fs::path& truth_file) {
  std::error_code code;
  if (!fs::exists(folder / "session.toml", code)) return {};  // what is unfinished is overwritten
  if (!fs::exists(truth_file, code))
    return BadInput(folder.string() + ": holds a session that no study wrote (" +
                    truth_file.filename().string() +
                    " is not beside it); choose another --out folder");
  std::vector<fs::path> old;
  fs::directory_iterator entry(folder, code);
  for (; !code && entry != fs::directory_iterator(); entry.increment(code)) {
    if (!IsPartOfSession(entry->path()))
      return BadInput(folder.string() + ": holds " + entry->path().filename().string() +
                      ", which no study wrote; choose another --out folder");
    old.push_back(entry->path());
  }
  if (code) return BadInput(folder.string() + ": cannot be listed: " + code.message());
  for (const fs::path& path : old)
    if (fs::remove_all(path, code); code)
      return OutputFailed(path.string() + ": cannot be removed: " + code.message());
  return {};
}

std::vector<double> TrueAxial_microstrain(const ExperimentTruth& truth) {
  std::vector<double> strains;
  for (const PipeTruth& state : truth.pipe)
    strains.push_back(1e6 * StrainOf(truth, state).long_base);
  return strains;
}

}  // namespace

int ImageOutcome::BoardsUsed() const {
  return static_cast<int>(
      std::count_if(detection.boards.begin(), detection.boards.end(),
                    [](const BoardObservation& board) { return board.rejected_because.empty(); }));
}

std::vector<double> ImageOutcome::RulerErrors_um() const {
  std::vector<double> errors_um;
  for (const RulerLength& length : rulers)
    if (length.rejected_because.empty()) errors_um.push_back(length.error_um);
  return errors_um;
}

std::vector<double> ImageOutcome::StrainErrors_microstrain() const {
  std::vector<double> errors;
  for (std::size_t i = 1; i < pipe.states.size(); ++i)
    errors.push_back(1e6 * pipe.states[i].strain.axial_strain - true_axial_microstrain[i]);
  return errors;
}

Result<ImageOutcome> RunImageExperiment(const VirtualExperimentOptions& options,
                                        const fs::path& folder, const std::string& name,
                                        Console& console) {
  const fs::path session_folder = folder / name;
  const fs::path truth_file = folder / (name + "-truth.json");
  TELESTRAIN_RETURN_IF_ERROR(ClearSession(session_folder, truth_file));
  TELESTRAIN_RETURN_IF_ERROR(WriteVirtualExperiment(options, session_folder, truth_file, console));
  ImageOutcome outcome;
  TELESTRAIN_ASSIGN_OR_RETURN(outcome.truth, InventTruth(options, NominalSession(options)));
  TELESTRAIN_ASSIGN_OR_RETURN(outcome.session, ReadSession(session_folder));
  TELESTRAIN_ASSIGN_OR_RETURN(outcome.detection, DetectAll(outcome.session, console));
  TELESTRAIN_ASSIGN_OR_RETURN(outcome.calibration,
                              Calibrate(outcome.session, outcome.detection.boards));
  const ArrayCalibration& array = outcome.calibration.bundle.state.array;
  outcome.rulers = MeasureRuler(outcome.session, array, outcome.detection.crosses);
  if (!outcome.rulers.empty() && outcome.RulerErrors_um().empty())
    return EstimationFailed("no ruler could be measured: " + outcome.rulers.front().image + ": " +
                            outcome.rulers.front().rejected_because);
  if (outcome.truth.pipe.empty()) return outcome;
  outcome.true_axial_microstrain = TrueAxial_microstrain(outcome.truth);
  PipeOptions correlation = DefaultPipeOptions(outcome.session);
  correlation.threads = options.threads;
  TELESTRAIN_ASSIGN_OR_RETURN(outcome.pipe,
                              MeasurePipe(outcome.session, array, correlation, console));
  return outcome;
}

}  // namespace telestrain
