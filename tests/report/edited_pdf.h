#pragma once

#include <functional>
#include <qpdf/QPDF.hh>
#include <string>

namespace telestrain {

// The PDF after `change` of its objects, written anew.
std::string EditedPdf(const std::string& bytes, const std::function<void(QPDF&)>& change);

// Adds the attachment, or gives the one of this name other bytes.
void AttachToPdf(QPDF& pdf, const std::string& name, const std::string& bytes);

void DetachFromPdf(QPDF& pdf, const std::string& name);

}  // namespace telestrain
