#include "report/report_attachments.h"

#include "base/files.h"
#include "base/json_file.h"
#include "report/audit/audit_trail.h"
#include "report/report_template.h"
#include "report/result_cells.h"

namespace telestrain {
namespace {

constexpr const char* kTrail = "audit.jsonl";

// In the order of the printed table.
std::vector<PdfAttachment> KnownFiles() {
  return {{"results.json", "application/json", "Every number of the report", "Data", ""},
          {"calibration.json", "application/json", "Calibration of the instrument", "Data", ""},
          {"dcc.xml", "application/xml", "Digital calibration certificate", "Alternative", ""},
          {"session.toml", "application/toml", "What was asked and certified", "Source", ""},
          {kTrail, "application/x-ndjson", "Audit trail", "Supplement", ""}};
}

// Hash and number of the entries of a trail; an empty hash without one.
struct TrailHead {
  std::string hash;
  std::size_t entries = 0;
};

TrailHead HeadOf(const std::string& trail) {
  TrailHead head;
  for (std::size_t at = 0; at < trail.size();) {
    const std::size_t end = std::min(trail.find('\n', at), trail.size());
    const std::string text = trail.substr(at, end - at);
    const auto line = ParseJson(text);
    const std::string hash = line ? TextAt(*line, "/hash") : "";
    if (!hash.empty()) head = {hash, head.entries + 1};
    at = end + 1;
  }
  return head;
}

}  // namespace

Result<std::vector<PdfAttachment>> ReportAttachments(const std::filesystem::path& results) {
  std::vector<PdfAttachment> attachments;
  for (PdfAttachment& attachment : KnownFiles()) {
    std::error_code code;
    if (!std::filesystem::exists(results / attachment.name, code)) continue;
    TELESTRAIN_ASSIGN_OR_RETURN(attachment.bytes,
                                ReadFile(results / attachment.name, kMostResultBytes));
    // What was done later, such as writing this very report, is not of these results.
    if (attachment.name == kTrail) attachment.bytes = TrailOfResults(attachment.bytes);
    attachments.push_back(std::move(attachment));
  }
  return attachments;
}

Json AttachmentsTable(const std::vector<PdfAttachment>& attachments) {
  Json table = {{"id", "attachments"}, {"title", "Files attached to this report"}};
  table["columns"] = {{{"name", "File"}, {"unit", ""}},
                      {{"name", "Content"}, {"unit", ""}},
                      {{"name", "Size"}, {"unit", "bytes"}},
                      {{"name", "SHA-256"}, {"unit", ""}}};
  table["rows"] = Json::array();
  for (const PdfAttachment& attachment : attachments) {
    const std::size_t size = attachment.bytes.size();
    table["rows"].push_back({attachment.name,
                             attachment.description,
                             {{"value", size}, {"printed", std::to_string(size)}},
                             Sha256Hex(attachment.bytes)});
    if (attachment.name != kTrail) continue;
    const TrailHead head = HeadOf(attachment.bytes);
    if (head.hash.empty()) continue;
    // The row below the trail's: where a reader of the report looks for its head.
    table["rows"].push_back(
        {"audit head",
         Phrase("Hash of the last of {{count}} entries", {{"count", std::to_string(head.entries)}}),
         "", head.hash});
  }
  return table;
}

Json WithAttachmentsTable(Json blocks, const Json& results) {
  constexpr const char* kId = "attachments";
  Json table = {{"type", "table"}, {"table", kId}, {"mono", {"SHA-256"}}};
  bool is_drawn = false;
  for (Json& block : blocks) {
    if (TextAt(block, "/type") != "table" || TextAt(block, "/table") != kId) continue;
    block["mono"] = table["mono"];
    block.erase("width_mm");  // a hash that is broken cannot be compared
    is_drawn = is_drawn || IsWanted(results, block);
  }
  if (is_drawn) return blocks;
  table["show_title"] = false;
  std::size_t at = 0;
  while (at < blocks.size() && TextAt(blocks[at], "/type") != "end-mark") ++at;
  const auto place = [&] { return blocks.begin() + static_cast<std::ptrdiff_t>(at); };
  blocks.insert(place(), table);
  blocks.insert(place(), Json{{"type", "heading"}, {"text", "Attached files"}});
  return blocks;
}

}  // namespace telestrain
