#include "report/audit/audit_trail.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include "base/files.h"
#include "base/parallel.h"
#include "report/audit/audit_line.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

const std::string kNoHash(64, '0');

Status CheckPlace(const std::string& where, const AuditEntry& entry, std::size_t index,
                  const std::string& prev) {
  if (entry.seq != static_cast<long long>(index))
    return BadInput(where + "has number " + std::to_string(entry.seq) + " where " +
                    std::to_string(index) + " follows: a line was taken out, put in or moved");
  if (entry.prev != prev)
    return BadInput(where + "does not follow the line before it: one of the two was exchanged");
  return {};
}

// Checking takes longer than all else that is done to a line, so it is shared among the cores.
Status CheckSignatures(const std::string& name, const std::vector<AuditEntry>& entries,
                       const Ed25519Key& key) {
  std::vector<char> valid(entries.size());
  ParallelFor(static_cast<int>(entries.size()), 0, [&](int i) {
    const AuditEntry& entry = entries[static_cast<std::size_t>(i)];
    valid[static_cast<std::size_t>(i)] = key.Verifies(entry.hash, entry.signature);
  });
  const auto bad = std::find(valid.begin(), valid.end(), 0);
  if (bad == valid.end()) return {};
  const auto index = static_cast<std::size_t>(bad - valid.begin());
  return BadInput(name + ": line " + std::to_string(index + 1) + " is not signed" +
                  (entries[index].signature.empty() ? "" : " by this key"));
}

// The lines without their ends.
Result<std::vector<std::string>> WholeLines(const std::string& name, const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    if (end == std::string::npos)
      return BadInput(name + ": line " + std::to_string(lines.size() + 1) +
                      " is cut short: the program was ended while it wrote it");
    lines.push_back(text.substr(begin, end - begin));
  }
  return lines;
}

// A line is understood by itself, on all cores; its place in the chain is asked afterwards.
Result<std::vector<AuditEntry>> ReadLines(const std::string& name, const std::string& text,
                                          const Ed25519Key* key) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<std::string> lines, WholeLines(name, text));
  const auto where = [&](std::size_t i) { return name + ": line " + std::to_string(i + 1) + " "; };
  std::vector<std::optional<Result<AuditEntry>>> read(lines.size());
  ParallelFor(static_cast<int>(lines.size()), 0, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    read[i] = ParseAuditLine(where(i), lines[i]);
  });
  std::vector<AuditEntry> entries;
  entries.reserve(lines.size());
  std::string prev = kNoHash;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    TELESTRAIN_ASSIGN_OR_RETURN(AuditEntry entry, std::move(*read[i]));
    TELESTRAIN_RETURN_IF_ERROR(CheckPlace(where(i), entry, i, prev));
    prev = entry.hash;
    entries.push_back(std::move(entry));
  }
  if (key) TELESTRAIN_RETURN_IF_ERROR(CheckSignatures(name, entries, *key));
  return entries;
}

}  // namespace

Result<AuditTrail> AuditTrail::Open(const fs::path& file, const fs::path& key_file) {
  AuditTrail trail;
  trail.file_ = file;
  if (!key_file.empty()) {
    TELESTRAIN_ASSIGN_OR_RETURN(trail.key_, Ed25519Key::ReadPrivate(key_file));
  }
  std::error_code code;
  if (!fs::exists(file, code)) return trail;
  TELESTRAIN_ASSIGN_OR_RETURN(std::string text, ReadFile(file, kMostLogBytes));
  const std::size_t last_end = text.rfind('\n');
  const std::size_t whole_bytes = last_end == std::string::npos ? 0 : last_end + 1;
  if (whole_bytes < text.size()) trail.whole_bytes_ = whole_bytes;
  text.resize(whole_bytes);
  TELESTRAIN_ASSIGN_OR_RETURN(trail.entries_,
                              ReadLines(file.string(), text, trail.key_ ? &*trail.key_ : nullptr));
  return trail;
}

Status AuditTrail::Append(const std::string& type, const Json& body, const std::string& time) {
  AuditEntry entry;
  entry.seq = static_cast<long long>(entries_.size());
  entry.time = time;
  entry.type = type;
  entry.body = body;
  entry.prev = head();
  const std::string entry_text = EntryText(entry);
  entry.hash = Sha256Hex(entry_text);
  if (key_) entry.signature = key_->Sign(entry.hash);
  std::string line = AuditLine(entry, entry_text);
  // Kept as it will be read again: sorted, with no text that JSON cannot hold.
  TELESTRAIN_ASSIGN_OR_RETURN(
      entry, ParseAuditLine(file_.string() + ": a new entry ", line.substr(0, line.size() - 1)));
  unsynced_ += line;
  entries_.push_back(std::move(entry));
  return {};
}

Status AuditTrail::Sync() {
  if (unsynced_.empty()) return {};
  if (whole_bytes_) {
    std::error_code code;
    fs::resize_file(file_, *whole_bytes_, code);
    if (code) return CannotWrite(file_, code.value());
    whole_bytes_.reset();
  }
  TELESTRAIN_RETURN_IF_ERROR(AppendToFile(file_, unsynced_));
  unsynced_.clear();
  return {};
}

Status AuditTrail::Replace() {
  if (unsynced_.empty()) return {};
  std::string text;
  std::error_code code;
  if (fs::exists(file_, code)) {
    TELESTRAIN_ASSIGN_OR_RETURN(text, ReadFile(file_, kMostLogBytes));
    if (whole_bytes_) text.resize(*whole_bytes_);
  }
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(file_, text + unsynced_));
  whole_bytes_.reset();
  unsynced_.clear();
  return {};
}

std::string AuditTrail::head() const { return entries_.empty() ? kNoHash : entries_.back().hash; }

bool AuditTrail::Repeats(const std::string& type, const Json& body) const {
  const auto latest = std::find_if(entries_.rbegin(), entries_.rend(),
                                   [&](const AuditEntry& entry) { return entry.type == type; });
  return latest != entries_.rend() && CanonicalJson(latest->body) == CanonicalJson(body);
}

Result<std::vector<AuditEntry>> ReadAuditTrail(const std::string& name, const std::string& text,
                                               const std::string& public_key_pem) {
  if (public_key_pem.empty()) return ReadLines(name, text, nullptr);
  TELESTRAIN_ASSIGN_OR_RETURN(const Ed25519Key key,
                              Ed25519Key::ReadPublic("the public key", public_key_pem));
  return ReadLines(name, text, &key);
}

std::string TrailOfResults(const std::string& text) {
  std::size_t end_of_results = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    const auto entry = ParseAuditLine("", text.substr(begin, end - begin));
    if (entry && entry->type == "results") end_of_results = end + 1;
    begin = end + 1;
  }
  return end_of_results > 0 ? text.substr(0, end_of_results) : text;
}

}  // namespace telestrain
