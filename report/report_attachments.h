#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "report/json_lookup.h"
#include "report/pdf_document.h"

namespace telestrain {

// The files of a results folder that its report carries, as far as they exist: results.json,
// calibration.json, dcc.xml, session.toml, and audit.jsonl up to the entry of these results. Fails
// (kBadInput) when one that exists cannot be read.
Result<std::vector<PdfAttachment>> ReportAttachments(const std::filesystem::path& results);

// What the report prints of them, a table "attachments" as results.json has them: name, content,
// size and SHA-256 of each; and "audit head", the hash of the trail's last entry, which shows when
// entries were cut off behind it, with their number.
Json AttachmentsTable(const std::vector<PdfAttachment>& attachments);

// A layout's blocks with that table: where the layout draws none from these results, it comes
// before the end mark, or last. Its hashes stay in one line: 'audit verify' compares them.
Json WithAttachmentsTable(Json blocks, const Json& results);

}  // namespace telestrain
