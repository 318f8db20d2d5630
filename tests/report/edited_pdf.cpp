#include "report/edited_pdf.h"

#include <memory>
#include <qpdf/Buffer.hh>
#include <qpdf/QPDFEmbeddedFileDocumentHelper.hh>
#include <qpdf/QPDFWriter.hh>

namespace telestrain {

std::string EditedPdf(const std::string& bytes, const std::function<void(QPDF&)>& change) {
  QPDF pdf;
  pdf.processMemoryFile("edited", bytes.data(), bytes.size());
  change(pdf);
  QPDFWriter writer(pdf);
  writer.setOutputMemory();
  writer.setStaticID(true);
  writer.write();
  const std::shared_ptr<Buffer> buffer = writer.getBufferSharedPointer();
  return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

void AttachToPdf(QPDF& pdf, const std::string& name, const std::string& bytes) {
  auto stream = QPDFEFStreamObjectHelper::createEFStream(pdf, bytes);
  auto file = QPDFFileSpecObjectHelper::createFileSpec(pdf, name, stream);
  QPDFEmbeddedFileDocumentHelper(pdf).replaceEmbeddedFile(name, file);
}

void DetachFromPdf(QPDF& pdf, const std::string& name) {
  QPDFEmbeddedFileDocumentHelper(pdf).removeEmbeddedFile(name);
}

}  // namespace telestrain
