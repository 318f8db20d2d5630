#pragma once

#include <string>
#include <vector>

#include "report/audit/audit_trail.h"

namespace telestrain {

// The story of a trail in plain words: a line per entry, a second with the options that were used
// where there are any. For results folders and for the instrument's log. Control characters of
// names are printed as \xNN.
std::vector<std::string> TellAudit(const std::vector<AuditEntry>& entries);

// The same of a results folder, a report.pdf (the trail inside, and who signed the report) or a
// file of lines. Fails (kBadInput) when there is no trail or its chain is broken.
Result<std::vector<std::string>> TellAuditOf(const std::filesystem::path& subject);

}  // namespace telestrain
