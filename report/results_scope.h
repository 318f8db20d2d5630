#pragma once

#include "report/acceptance_report.h"
#include "report/result_cells.h"

namespace telestrain {

// What a layout decides about: its sections and limits (ReportScope).

// Fails (kBadInput) with the nearest known word for a section or a limit that does not exist.
Status CheckScope(const ReportScope& scope);

bool IsInScope(const ReportScope& scope, const std::string& section);

// Replaces the session's limits by the layout's and adds the sentence "limits" that says so; ""
// when nothing was replaced.
void ApplyLimits(const ReportScope& scope, ResultsDraft& draft);

// Drops the quantities of other sections and says that these were not measured.
void LeaveScope(const ReportScope& scope, ResultsDraft& draft);

}  // namespace telestrain
