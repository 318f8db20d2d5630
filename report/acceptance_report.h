#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"

namespace telestrain {

// What the limits decide together.
struct Outcome {
  std::string verdict;    // "pass", "doubt", "fail", or "undecided": a limit could not be decided,
                          // or there is none
  bool accepted = false;  // pass, or nothing to decide about what was measured; never without any
                          // measured section
};

// The acceptance report of a results folder. `MakeResults` collects every number that the report
// prints in one file, results.json, with its unit, uncertainty, limit, verdict and the very text
// that is printed; `WriteAcceptanceReport` lays these texts out as report.pdf. The two can
// therefore not differ. Both are pure functions of the folder: same input, same bytes.

// Reads inputs.json (must be there) and what exists of detection.json, calibration.json, ruler.json
// and strain.json; writes results.json. Fails with kBadInput (a file is malformed) or
// kOutputFailed.
Result<Outcome> MakeResults(const std::filesystem::path& results);

struct ReportOptions {
  // Folder that holds acceptance.json, the layout and its texts. Empty: the one that was built in,
  // so that a report never depends on where the program was installed.
  std::filesystem::path templates;
};

// Writes report.pdf (A4, fonts embedded, bookmarks) from results.json, pictures/*.png and, for the
// residual charts, calibration.json and residuals.csv. Creation date: document.date (ISO 8601) of
// results.json, else the environment's SOURCE_DATE_EPOCH, else none.
// Fails with kBadInput (results.json missing; template wrong, with the JSON pointer; a picture or
// table malformed) or kOutputFailed (fonts missing, libharu, disk) and then leaves no file.
Status WriteAcceptanceReport(const std::filesystem::path& results,
                             const ReportOptions& options = {});

}  // namespace telestrain
