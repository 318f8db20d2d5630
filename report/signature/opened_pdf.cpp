#include "report/signature/opened_pdf.h"

#include <exception>
#include <qpdf/Buffer.hh>

#include "report/reading/classic_pdf.h"

namespace telestrain {

OpenedPdf OpenPdf(const std::string& bytes) {
  if (const std::string reason = WhyNotClassicPdf(bytes); !reason.empty())
    return {nullptr, "the PDF is damaged: " + reason};
  OpenedPdf opened{std::make_unique<QPDF>(), ""};
  opened.pdf->setSuppressWarnings(true);
  opened.pdf->setAttemptRecovery(false);
  try {
    opened.pdf->processMemoryFile("report", bytes.data(), bytes.size());
    // Every object once, so that damage shows now. Numbers are used once: an object of another
    // generation would be a second one of the same number.
    for (const QPDFObjectHandle& object : opened.pdf->getAllObjects())
      if (object.getGeneration() != 0)
        opened.failure = "the PDF has an object of another generation than 0, number " +
                         std::to_string(object.getObjectID()) + ", which telestrain never writes";
    if (opened.pdf->isEncrypted()) opened.failure = "the PDF is encrypted";
  } catch (const std::exception& error) {
    opened.failure = std::string("the PDF is damaged: ") + error.what();
  }
  if (opened.failure.empty())
    if (const auto warnings = opened.pdf->getWarnings(); !warnings.empty())
      opened.failure = std::string("the PDF is damaged: ") + warnings.front().what();
  if (!opened.failure.empty()) opened.pdf.reset();
  return opened;
}

std::string ContentOf(QPDFObjectHandle object) {
  if (!object.isStream()) return object.unparseResolved();
  const auto data = object.getRawStreamData();
  return object.getDict().unparse() +
         std::string(reinterpret_cast<const char*>(data->getBuffer()), data->getSize());
}

std::vector<SignatureField> SignatureFieldsOf(QPDF& pdf) {
  std::vector<SignatureField> fields;
  QPDFObjectHandle form = pdf.getRoot().getKey("/AcroForm");
  QPDFObjectHandle list = form.isDictionary() ? form.getKey("/Fields") : form;
  if (!list.isArray()) return fields;
  for (QPDFObjectHandle field : list.getArrayAsVector()) {
    if (!field.isDictionary()) continue;
    QPDFObjectHandle name = field.getKey("/T");
    if (field.hasKey("/V") || field.getKey("/FT").isNameAndEquals("/Sig"))
      fields.push_back({name.isString() ? name.getUTF8Value() : "", field});
  }
  return fields;
}

}  // namespace telestrain
