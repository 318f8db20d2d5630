#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/acceptance_report.h"
#include "report/report_template.h"

namespace telestrain {

// What the tests that read reports back share.

struct ReportCase {
  std::string layout, language;
};
// The four layouts in the languages that are built in.
std::vector<ReportCase> AllReportCases();
std::string NameOf(const ReportCase& report);

// Makes results.json, dcc.xml and report.pdf of a results folder; a layout that compares with an
// earlier report gets one with another ruler check. Throws std::runtime_error with the message.
void MakeReport(const std::filesystem::path& folder, const ReportCase& report,
                ArchiveLevel level = ArchiveLevel::k3a);
Json ReadResults(const std::filesystem::path& folder);
ReportTemplate TemplateOf(const ReportCase& report);

// The text of report.pdf in the order in which it was drawn, so that a cell or a row stands in one
// piece whatever its lines; without white space.
std::string DrawnText(const std::filesystem::path& folder);

// Rows, titles and column heads of the layout's tables that do not stand in `drawn`, in words.
std::vector<std::string> MissingOfTables(const Json& results, const ReportTemplate& layout,
                                         const std::string& drawn);
// The same for quantities: value, U, limit, unit and verdict of each in one piece, k in the text.
std::vector<std::string> MissingOfQuantities(const Json& results, const ReportTemplate& layout,
                                             const std::string& drawn);

}  // namespace telestrain
