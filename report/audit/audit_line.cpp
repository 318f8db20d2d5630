#include "report/audit/audit_line.h"

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/json_file.h"

namespace telestrain {
namespace {

using SortedJson = nlohmann::json;

// Entries are flat; what is deeper is none of ours and would only cost the stack.
constexpr int kDeepest = 64;

std::string Dump(const SortedJson& json) {
  return json.dump(-1, ' ', false, SortedJson::error_handler_t::replace);
}

SortedJson TextOrNull(const std::string& text) {
  return text.empty() ? SortedJson(nullptr) : SortedJson(text);
}

// Null is empty; throws for anything else but a text.
std::string TextOf(const SortedJson& json) { return json.is_null() ? "" : json.get<std::string>(); }

AuditEntry EntryOf(const SortedJson& json) {
  const SortedJson& inner = json.at("entry");
  AuditEntry entry;
  entry.seq = inner.at("seq").get<long long>();
  entry.time = TextOf(inner.at("time"));
  entry.type = inner.at("type").get<std::string>();
  entry.prev = inner.at("prev").get<std::string>();
  entry.body = Json(inner.at("body"));
  entry.hash = json.at("hash").get<std::string>();
  entry.signature = TextOf(json.at("sig"));
  return entry;
}

}  // namespace

std::string CanonicalJson(const Json& json) { return Dump(SortedJson(json)); }

std::string EntryText(const AuditEntry& entry) {
  return Dump({{"v", 1},
               {"seq", entry.seq},
               {"time", TextOrNull(entry.time)},
               {"type", entry.type},
               {"prev", entry.prev},
               {"body", SortedJson(entry.body)}});
}

std::string AuditLine(const AuditEntry& entry, const std::string& entry_text) {
  const SortedJson rest{{"hash", entry.hash}, {"sig", TextOrNull(entry.signature)}};
  return "{\"entry\":" + entry_text + "," + Dump(rest).substr(1) + "\n";
}

Result<AuditEntry> ParseAuditLine(const std::string& where, const std::string& line) {
  if (const auto text = CheckJsonText(line, kDeepest); !text)
    return BadInput(where + text.error().message);
  AuditEntry entry;
  std::string entry_text;
  try {
    entry = EntryOf(SortedJson::parse(line));
    entry_text = EntryText(entry);
  } catch (const SortedJson::parse_error&) {
    return BadInput(where + "is not JSON");
  } catch (const SortedJson::exception&) {
    return BadInput(where + "is no entry of an audit trail, version 1");
  }
  if (entry.hash != Sha256Hex(entry_text))
    return BadInput(where + "was changed: its entry has another hash than the line says");
  if (AuditLine(entry, entry_text) != line + "\n")
    return BadInput(where + "is not written as this program writes an entry");
  return entry;
}

}  // namespace telestrain
