#pragma once

#include <filesystem>

#include "base/console.h"
#include "base/result.h"
#include "session/session.h"

namespace telestrain {

// The steps from a session folder to a report. Each reads the session and what earlier steps left
// in the results folder, writes its own files there and says what it found. Before it writes, it
// removes its own and all later steps' files, so that a results folder never mixes two runs.

// Reads the session, prepares the results folder and writes inputs.json with every file's hash.
Result<Session> OpenSession(const std::filesystem::path& folder,
                            const std::filesystem::path& results);
// For the steps after `detect`: reads the session and requires that inputs.json was made from it.
Result<Session> ReopenSession(const std::filesystem::path& folder,
                              const std::filesystem::path& results);

Status DetectStep(const Session& session, const std::filesystem::path& results, Console& console);
Status CalibrateStep(const Session& session, const std::filesystem::path& results,
                     Console& console);
Status VerifyStep(const Session& session, const std::filesystem::path& results, Console& console);
Status MeasureStep(const Session& session, const std::filesystem::path& results, Console& console);
Status RenderStep(const std::filesystem::path& results, Console& console);
// Writes results.json and report.pdf, with the layout in `templates` when that is not empty. The
// value is the exit code of the verdict.
Result<int> ReportStep(const std::filesystem::path& results, const std::filesystem::path& templates,
                       Console& console);

}  // namespace telestrain
