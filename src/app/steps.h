#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/command.h"
#include "app/results_lock.h"
#include "app/watched_folder.h"
#include "base/console.h"
#include "base/result.h"
#include "calibration/calibrate.h"
#include "report/acceptance_report.h"
#include "session/session.h"
#include "viz/render.h"

namespace telestrain {

// The steps from a session folder to a report. Each reads the session and what earlier steps left
// in the results folder, writes its own files there and says what it found. Before it writes, it
// removes its own and all later steps' files, so that a results folder never mixes two runs.

// Every step that writes results adds its entry to the folder's audit.jsonl, at its end.

// What becomes of the files that an earlier run of the same step left. `kKept`: when the trail says
// that they were made by this program from the same inputs with the same options, and they lie
// there as they were made, the step is not done again and says so.
enum class Earlier { kMadeAgain, kKept };

// Reads the session, prepares the results folder and writes inputs.json with every file's hash,
// session.toml as it was read, and session.path: where the session lies.
// With `corners` (a corners.vnl; or empty) the calibration images need not be there. `lock` is of
// the results folder, and taken again when that is made here.
Result<Session> OpenSession(const std::filesystem::path& folder,
                            const std::filesystem::path& results,
                            const std::filesystem::path& corners, ResultsLock& lock,
                            Earlier earlier = Earlier::kMadeAgain);
// For the steps after `detect`: reads the session and requires that inputs.json was made from it.
Result<Session> ReopenSession(const std::filesystem::path& folder,
                              const std::filesystem::path& results);

// The calibration in the results folder, which must be of this session's views.
Result<ArrayCalibration> LoadCalibration(const Session& session,
                                         const std::filesystem::path& results);

Status DetectStep(const Session& session, const std::filesystem::path& results,
                  const std::filesystem::path& corners, Console& console,
                  Earlier earlier = Earlier::kMadeAgain);

// A calibration.json with its hash.
struct EarlierCalibration {
  std::filesystem::path path;
  ArrayCalibration array;
  std::string sha256;
};

// How `calibrate` works beside its defaults.
struct CalibrateChoices {
  CalibrateArguments arguments;  // as they were given
  CalibrationOptions options;
  // An earlier calibration; writes comparison.json. Read before the results folder is opened,
  // where it may lie.
  std::optional<EarlierCalibration> earlier;
};
// Reads the earlier calibration when one is named. Fails (kUsage) for a culled region that is none.
Result<CalibrateChoices> ReadChoices(const CalibrateArguments& arguments);
Status CalibrateStep(const Session& session, const std::filesystem::path& results,
                     const CalibrateChoices& choices, Console& console,
                     Earlier earlier = Earlier::kMadeAgain);
// Reads the results folder only; `with_table`: says every figure, not only the outcome. The value
// is an exit code: 1 when mrcal disagrees.
Result<int> DiagnoseStep(const std::filesystem::path& results, bool with_table, Console& console);
// As `run` does it: only the outcome, which decides nothing.
Status DiagnoseStep(const std::filesystem::path& results, Console& console, Earlier earlier);
Status VerifyStep(const Session& session, const std::filesystem::path& results, Console& console,
                  Earlier earlier = Earlier::kMadeAgain);

// How `measure` works beside its defaults.
struct MeasureChoices {
  MeasureArguments arguments;      // as they were given
  int subset_px = 0, step_px = 0;  // 0: as DefaultPipeOptions
  std::optional<WatchChoices> watch;
};
// Fails (kUsage) for a number outside its range.
Result<MeasureChoices> ReadChoices(const MeasureArguments& arguments);
// Goes on from the states that an earlier run of the same inputs left.
Status MeasureStep(const Session& session, const std::filesystem::path& results,
                   const MeasureChoices& choices, Console& console,
                   Earlier earlier = Earlier::kMadeAgain);
// The standard pictures as the report wants them.
Status RenderStep(const std::filesystem::path& results, Console& console, Earlier earlier);
// Other pictures; `out` empty: the results' pictures folder, where a single view replaces its own
// file and nothing else goes but a report that shows it.
Status RenderStep(const std::filesystem::path& results, const RenderOptions& options,
                  const std::filesystem::path& out, Console& console);
// How `report` works beside its defaults.
struct ReportChoices {
  std::filesystem::path templates;  // the user's own; empty: built-in ones only
  std::string layout = "acceptance", language = "en";
  std::filesystem::path against;  // an earlier results folder or report.pdf; empty: none
  ArchiveLevel level = ArchiveLevel::k3a;
};
// Writes results.json and report.pdf. The value is the exit code of the verdict. Fails with kUsage
// (no such layout or language; a layout that compares without `against`, or the other way round).
Result<int> ReportStep(const std::filesystem::path& results, const ReportChoices& choices,
                       Console& console, Earlier earlier = Earlier::kMadeAgain);

}  // namespace telestrain
