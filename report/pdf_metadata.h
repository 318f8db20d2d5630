#pragma once

// Included by the pdf_*.cpp files only: libharu stays inside them.

#include <string>

#include "report/pdf_document.h"
#include "report/pdf_objects.h"

namespace telestrain {

// What the document says about itself in the one form that both places, the information dictionary
// and the XMP packet, can hold: no control characters, no blanks at the ends, never without title
// and language. `created` stays only if it is a PDF date "D:YYYYMMDDHHmmSSZ".
PdfInfo CleanInfo(const PdfInfo& info);

// Writes information dictionary, XMP packet, language and viewer preferences into the document.
void WriteMetadata(PdfObjects& objects, HPDF_Doc document, const PdfInfo& info, ArchiveLevel level);

// The meaning of the colours: `profile` is an ICC profile of sRGB.
void WriteOutputIntent(PdfObjects& objects, HPDF_Doc document, const std::string& profile);

}  // namespace telestrain
