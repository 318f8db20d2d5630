#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "report/signature/signature_check.h"

namespace telestrain {

// `telestrain audit verify`.
struct AuditQuestion {
  std::filesystem::path subject;  // a results folder, its report.pdf, a report anywhere, or a log
  std::filesystem::path
      session;         // empty: where session.path says; not there: inputs are not checked
  TrustOptions trust;  // whose signatures in the report count
  // The instrument's log, which must tell of the results folder's latest entry; may be empty.
  std::filesystem::path log;
  std::filesystem::path
      public_key;  // PEM; every line of the log must be signed by its private half
};

struct AuditAnswer {
  bool passed = false;
  std::string line;  // begins with PASS or FAIL and says what was checked or what is wrong
};

// A results folder: the chain of its audit.jsonl; that every file is as the latest entry made it
// and every step read what the one before had made; that the session is as it was read; its
// report.pdf (CheckReport). A report.pdf with an audit.jsonl beside it is its results folder; any
// other is checked for all that it holds, and its inputs when the session is named. Who is trusted
// or required must have signed: a report that is missing or not signed fails then. Control
// characters of names are printed as \xNN. Fails only when the subject, the named session, a
// certificate or a key cannot be read (kBadInput) or is of no such kind (kUsage).
Result<AuditAnswer> VerifyAudit(const AuditQuestion& question);

}  // namespace telestrain
