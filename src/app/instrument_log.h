#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

// The instrument's own log, one file over all sessions: a line per run of the program with the
// clock's time, who ran it where, the words, how it ended and the head of the results' audit trail.
// With a key every line is signed. The chain is that of report/audit/audit_trail.h.
struct InstrumentLog {
  std::filesystem::path file;      // empty: none is kept
  std::filesystem::path key_file;  // Ed25519 in PEM; empty: lines are not signed
};

// Fails with kUsage (a key without a log) or kBadInput (the log's chain is broken, the key is none
// or another than the log's), so that no run begins that could not be logged.
Status CheckLog(const InstrumentLog& log);

// A finished run.
struct LoggedRun {
  std::string verb;
  std::vector<std::string> words;  // what stood after the program's name
  std::filesystem::path results;   // the folder that the verb read or wrote; may be empty
  int exit_code = 0;
};

// Adds its line; waits while another process adds one. A word that is a password, as the value of
// an option named so, is not written. Fails as CheckLog does, or with kOutputFailed.
Status LogRun(const InstrumentLog& log, const LoggedRun& run);

}  // namespace telestrain
