#pragma once

#include <memory>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFObjectHandle.hh>
#include <string>
#include <vector>

namespace telestrain {

// What signing and its check need of libqpdf.

struct OpenedPdf {
  std::unique_ptr<QPDF> pdf;
  std::string failure;  // why there is no pdf
};
// Reads it strictly: what libqpdf would have to guess or repair is a failure. `bytes` must outlive
// the pdf.
OpenedPdf OpenPdf(const std::string& bytes);

// What an object is, for comparing: its text with references as numbers, and a stream's bytes.
std::string ContentOf(QPDFObjectHandle object);

struct SignatureField {
  std::string role;
  QPDFObjectHandle field;
  bool IsSigned() { return field.hasKey("/V"); }
};
// All signature fields of the form, by its order.
std::vector<SignatureField> SignatureFieldsOf(QPDF& pdf);

}  // namespace telestrain
