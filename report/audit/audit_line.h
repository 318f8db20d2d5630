#pragma once

#include <string>

#include "report/audit/audit_trail.h"

namespace telestrain {

// JSON text with sorted keys and no blanks, so that equal values have equal bytes. Text that is not
// UTF-8 (a path) has U+FFFD in place of what cannot be said.
std::string CanonicalJson(const Json& json);

// The text over which an entry's hash goes.
std::string EntryText(const AuditEntry& entry);
// The line of an entry with hash and signature, with its end; `entry_text` is its EntryText.
std::string AuditLine(const AuditEntry& entry, const std::string& entry_text);

// Reads one line without its end; only the exact text that AuditLine would write is taken, so that
// no byte of a trail can change unseen. Fails (kBadInput) with what is wrong: it is not JSON, not
// of this form, or its hash is not that of its entry. `where` stands before the words.
Result<AuditEntry> ParseAuditLine(const std::string& where, const std::string& line);

}  // namespace telestrain
