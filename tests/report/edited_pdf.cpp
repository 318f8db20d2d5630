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

namespace {

// The associated files of the document are its attachments, as in our reports.
void AssociateAll(QPDF& pdf) {
  auto list = QPDFObjectHandle::newArray();
  for (const auto& [name, file] : QPDFEmbeddedFileDocumentHelper(pdf).getEmbeddedFiles())
    list.appendItem(file->getObjectHandle());
  pdf.getRoot().replaceKey("/AF", list);
}

}  // namespace

void AttachToPdf(QPDF& pdf, const std::string& name, const std::string& bytes) {
  auto stream = QPDFEFStreamObjectHelper::createEFStream(pdf, bytes);
  auto file = QPDFFileSpecObjectHelper::createFileSpec(pdf, name, stream);
  QPDFEmbeddedFileDocumentHelper(pdf).replaceEmbeddedFile(name, file);
  AssociateAll(pdf);
}

void DetachFromPdf(QPDF& pdf, const std::string& name) {
  QPDFEmbeddedFileDocumentHelper(pdf).removeEmbeddedFile(name);
  AssociateAll(pdf);
}

}  // namespace telestrain
