#pragma once

// Included by the pdf_*.cpp files only: libharu stays inside them.

#include <vector>

#include "report/pdf_document.h"
#include "report/pdf_objects.h"

namespace telestrain {

// Embeds the files in the order of their names, as associated files of the whole document (ISO
// 19005-3, 6.8). `created` is their date, a PDF date or empty.
void WriteAttachments(PdfObjects& objects, HPDF_Dict catalog,
                      std::vector<PdfAttachment> attachments, const std::string& created);

}  // namespace telestrain
