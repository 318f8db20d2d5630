#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

// What a report of ours holds beside its looks.
struct PdfContents {
  std::map<std::string, std::string> attachments;  // by name
  std::vector<std::string> page_texts;  // UTF-8, a line per piece of text, in drawing order
  // SHA-256 of attachments as a person reads them: of the rows that begin with the name of one.
  std::map<std::string, std::string> printed_hashes;
  std::string printed_head;  // of the row below that of audit.jsonl; empty without one
};

// Reads it with libqpdf. `name` is for errors. Fails (kBadInput) when the bytes are no PDF, are
// damaged, are built or draw otherwise than our reports, attach files in more than one way, or
// print two different hashes of one attachment.
Result<PdfContents> ReadPdfContents(const std::string& name, const std::string& bytes);

}  // namespace telestrain
