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
};

// Reads it with libqpdf. `name` is for errors. Fails (kBadInput) when the bytes are no PDF, are
// damaged, or are of another program's making where that matters.
Result<PdfContents> ReadPdfContents(const std::string& name, const std::string& bytes);

}  // namespace telestrain
