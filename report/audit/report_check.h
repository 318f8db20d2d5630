#pragma once

#include <filesystem>
#include <string>

#include "report/audit/audit_trail.h"
#include "report/signature/signature_check.h"

namespace telestrain {

// The audit trail of the results folder beside a report.
struct FolderTrail {
  std::string text;
  std::vector<AuditEntry> entries;
};

// Checks a report.pdf: the audit trail inside is whole and ends with the printed head; every
// attachment is the one whose SHA-256 is printed and the one that the trail says was made;
// signatures are valid, and there where somebody is trusted. With `folder` also: the trail inside
// is the beginning of the folder's, and every signature that the folder's trail tells of is there.
// A report of level 1b carries nothing: it must be the one that the folder's latest "report" made,
// or be signed. The value says in words what was found ("5 attachments as printed, not signed").
// Fails (kBadInput) with the first fault as one sentence.
Result<std::string> CheckReport(const std::string& name, const std::string& bytes,
                                const TrustOptions& trust, const FolderTrail* folder);

}  // namespace telestrain
