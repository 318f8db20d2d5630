#include "base/files.h"
#include "base/json_file.h"
#include "report/acceptance_report.h"
#include "report/layout_notes.h"
#include "report/report_template.h"
#include "report/study_report.h"
#include "report/template_list.h"
#include "robustness/fuzz/fuzz_target.h"

namespace telestrain::fuzz {
namespace {

// "own/…" is the user's folder of templates.
const std::set<std::string> kFiles{"own/own.json",
                                   "own/sections/part.json",
                                   "own/texts/de.json",
                                   "own/texts/en.json",
                                   "results.json",
                                   "calibration.json",
                                   "residuals.csv",
                                   "mrcal.json",
                                   "study.json",
                                   "session.toml",
                                   "dcc.xml"};

void TryTexts(const ReportTemplate& layout, const Json& results) {
  for (const std::string& note : LayoutNotes(layout, results))
    Require(!note.empty(), "a note says something");
  const auto said = layout.SayTables(results);
  if (Succeeds(said)) static_cast<void>(layout.FillValues(*said));
}

void TryReport(const std::filesystem::path& folder) {
  ReportOptions options;
  options.templates = folder / "own";
  options.name = "own";
  options.language = "de";
  options.level = ArchiveLevel::k1b;
  Succeeds(ScopeOfLayout(options));
  const auto layout = ReportTemplate::Load({options.templates, options.name, options.language});
  if (!Succeeds(layout)) return;
  const auto results = ReadJson(folder / "results.json", "telestrain.results/1", "");
  if (!Succeeds(results)) return;
  TryTexts(*layout, *results);
  const auto written = WriteReport(folder, options);
  const bool is_there = std::filesystem::exists(folder / "report.pdf");
  Require(Succeeds(written) == is_there, "a report is there when it was written, and only then");
}

}  // namespace

void FuzzReport(std::string_view input) {
  static MemoryFolder folder("report_");
  const auto files = FilesIn(input, kFiles);
  std::filesystem::create_directories(folder.path() / "own");
  folder.Hold(files, kFiles);
  if (files.contains("own/own.json")) TryReport(folder.path());
  if (files.contains("own/texts/de.json")) Succeeds(ListTemplates(folder.path() / "own"));
  if (files.contains("study.json"))
    Succeeds(WriteStudyReport(folder.path() / "study.json", folder.path() / "study.pdf"));
}

}  // namespace telestrain::fuzz
