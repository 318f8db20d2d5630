#pragma once

#include <string>
#include <vector>

#include "report/pdf_document.h"

namespace telestrain {

// Three pages with everything that PdfDocument can draw, tag, link and attach; a cell and a
// paragraph go over a page break.
PdfInfo SampleInfo();
std::vector<std::string> SampleLines();  // of text, one below the other
std::vector<PdfAttachment> SampleAttachments();
std::string SamplePdf(ArchiveLevel level, const PdfInfo& info = SampleInfo());

}  // namespace telestrain
