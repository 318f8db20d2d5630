#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "report/pdf_document.h"

namespace telestrain {

// What the limits decide together.
struct Outcome {
  std::string verdict;    // "pass", "doubt", "fail", or "undecided": a limit could not be decided,
                          // or there is none
  bool accepted = false;  // pass, or nothing to decide about what was measured; never without any
                          // measured section
};

// The report of a results folder. `MakeResults` collects every number that the report prints in one
// file, results.json, with its unit, uncertainty, limit, verdict and the very text that is printed,
// and writes the calibration certificate dcc.xml beside it; `WriteReport` lays these texts out as
// report.pdf. They can therefore not differ. All are pure functions of the folder and the options:
// same input, same bytes.

// What a report is about; its layout (templates/NAME.json) says it.
struct ReportScope {
  std::string name = "acceptance";  // of the layout
  // Of "calibration", "diagnosis", "ruler", "strain": only quantities of these sections are decided
  // and only these sections count as measured. Empty: all.
  std::vector<std::string> sections;
  // Limits that replace the session's, by their keys in session.toml ("ruler_mpe_um").
  std::map<std::string, double> limits;
  // An earlier results folder or report.pdf of the same instrument: adds the table "changes".
  std::filesystem::path earlier;
};

// Reads inputs.json (must be there) and what exists of detection.json, calibration.json,
// comparison.json, ruler.json and strain.json; writes results.json and dcc.xml. Once everything is
// read and before anything is written, `before_writing` is called; what it fails with is returned.
// Fails with kBadInput (a file is malformed; `earlier` cannot be read or compared) before that
// call, with kOutputFailed after it.
Result<Outcome> MakeResults(
    const std::filesystem::path& results, const ReportScope& scope = {},
    const std::function<Status()>& before_writing = [] { return Status(); });

// The outcome that a results.json tells of.
Outcome OutcomeIn(const nlohmann::ordered_json& results);

struct ReportOptions {
  // Folder of the user's own layouts and texts; what it lacks is taken from those that were built
  // in, so that a report never depends on where the program was installed.
  std::filesystem::path templates;
  std::string name = "acceptance";  // of the layout: NAME.json
  std::string language = "en";      // of the texts: texts/LANGUAGE.json
  ArchiveLevel level = ArchiveLevel::k3a;
  // Called for every wording that the language lacks and that is printed in English; may be empty.
  std::function<void(const std::string&)> on_untranslated = {};
  // Called for what the layout asks for in vain (LayoutNotes); may be empty.
  std::function<void(const std::string&)> on_note = {};
};

// Writes report.pdf (A4, PDF/A-3a and PDF/UA-1, fonts embedded, bookmarks) from results.json,
// pictures/*.png and, for the residual charts, calibration.json and residuals.csv; attaches
// results.json, calibration.json, dcc.xml, session.toml and the audit trail up to the entry of
// these results, as far as they exist. Creation date: document.date (ISO 8601) of results.json,
// else the environment's SOURCE_DATE_EPOCH, else none. Fails with kBadInput (results.json missing;
// template wrong, with the JSON pointer; a picture or table malformed) or kOutputFailed (fonts
// missing, libharu, disk) and then leaves no file.
Status WriteReport(const std::filesystem::path& results, const ReportOptions& options = {});

}  // namespace telestrain
