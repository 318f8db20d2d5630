#pragma once

#include <string>
#include <vector>

#include "report/report_template.h"

namespace telestrain {

// What a layout asks for and does not get, a line each; no error, for it may be meant: labels for
// texts that do not exist, entries of [document] that the session lacks and that no section of the
// text guards. `results`: results.json.
std::vector<std::string> LayoutNotes(const ReportTemplate& layout, const Json& results);

}  // namespace telestrain
