#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "report/audit/ed25519_key.h"
#include "report/json_lookup.h"

namespace telestrain {

// The audit trail: append-only JSON lines {"entry": {v, seq, time, type, prev, body}, "hash",
// "sig"}, keys sorted, no blanks. `hash` is the SHA-256 of the entry's text, `prev` the hash before
// it (64 zeros at the start), `sig` the instrument's Ed25519 signature of the hash, null without a
// key.
//
// A results folder's audit.jsonl says what its files were made from. Its `time` is the declared one
// (document.date of the session, else SOURCE_DATE_EPOCH, else null), never the clock's: same input,
// same bytes. The instrument's log, one file across sessions, has the clock's time.

// One line of it.
struct AuditEntry {
  long long seq = 0;
  std::string time;  // ISO 8601, or empty
  std::string type;  // "open", the name of a verb, "results", "report", "sign"
  Json body;
  std::string prev, hash, signature;  // hex, hex, base64 or empty
};

class AuditTrail {
 public:
  // Reads and checks the whole chain; a file that does not exist is an empty trail. A last line
  // that a killed program left without its end is dropped. `key_file`: the instrument's private
  // key (PEM, Ed25519), or empty; with it, every line must be signed by it. Fails (kBadInput) with
  // the line and what is wrong with it.
  static Result<AuditTrail> Open(const std::filesystem::path& file,
                                 const std::filesystem::path& key_file = {});

  // Adds a line. The file has it, synced, when `Sync` returns. Fails (kBadInput) for a body that
  // could not be read again (nested deeper than 64).
  Status Append(const std::string& type, const Json& body, const std::string& time);
  Status Sync();
  // As Sync, but writes the whole file anew, so that it is the old one or the new one at any
  // moment. For a trail that is held by its folder; what holds the file itself would hold the old
  // one.
  Status Replace();

  const std::vector<AuditEntry>& entries() const { return entries_; }
  // The hash of the last entry, 64 zeros without one.
  std::string head() const;
  // Whether the latest entry of this type has this body: repeating a step adds nothing.
  bool Repeats(const std::string& type, const Json& body) const;

 private:
  std::filesystem::path file_;
  std::optional<Ed25519Key> key_;
  std::vector<AuditEntry> entries_;
  std::string unsynced_;
  std::optional<std::uintmax_t> whole_bytes_;  // of a file whose last line is torn
};

// The entries of a trail's text. `public_key_pem`: when given, every line must be signed by it.
// Fails (kBadInput) with the line and what is wrong: cut short, not JSON, seq, prev, hash,
// signature.
Result<std::vector<AuditEntry>> ReadAuditTrail(const std::string& name, const std::string& text,
                                               const std::string& public_key_pem = "");

// The lines of `text` up to the latest entry of type "results": what a report carries, so that
// writing it again gives the same bytes. All lines when there is none.
std::string TrailOfResults(const std::string& text);

}  // namespace telestrain
