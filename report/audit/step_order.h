#pragma once

#include <string>

#include "report/audit/audit_trail.h"

namespace telestrain {

// Whether doing a step of type `later` again takes away what a step of type `earlier` had made from
// its results: an entry "calibrate" after "verify" means that the ruler's files were removed. Types
// that make nothing in the results folder, such as "export", take away nothing and stay.
bool Supersedes(const std::string& later, const std::string& earlier);

// Whether the entry is superseded by one after it.
bool IsSuperseded(const std::vector<AuditEntry>& entries, std::size_t index);

// Whether the trail says already that this step was done, with these facts, and nothing before it
// in the chain of steps was done since: then there is nothing to add.
bool IsRecorded(const AuditTrail& trail, const std::string& type, const Json& body);

}  // namespace telestrain
