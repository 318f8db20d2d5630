#include "report/reading/pdf_contents.h"

#include <qpdf/QPDFEmbeddedFileDocumentHelper.hh>
#include <stdexcept>

#include "report/reading/page_text.h"

namespace telestrain {
namespace {

// Far more than a report of ours has; a hostile file must not fill the memory.
constexpr std::size_t kMostFileBytes = std::size_t{256} << 20;
constexpr std::size_t kMostAttachmentBytes = std::size_t{256} << 20;  // of all together
constexpr std::size_t kMostPageBytes = std::size_t{64} << 20;         // drawing of one page
constexpr std::size_t kMostTextBytes = std::size_t{64} << 20;         // of all pages
constexpr std::size_t kMostPages = 5000;

using Attachments = std::map<std::string, std::string>;

void Open(QPDF& pdf, const std::string& name, const std::string& bytes) {
  pdf.setSuppressWarnings(true);
  pdf.setAttemptRecovery(false);  // what has to be guessed is no evidence
  pdf.processMemoryFile(name.c_str(), bytes.data(), bytes.size());
  if (pdf.isEncrypted()) throw std::runtime_error("it is encrypted, which no report of ours is");
}

Attachments AttachmentsOf(QPDF& pdf) {
  Attachments attachments;
  std::size_t left = kMostAttachmentBytes;
  for (const auto& [key, file] : QPDFEmbeddedFileDocumentHelper(pdf).getEmbeddedFiles()) {
    // What a reader shows is the name in the file specification.
    const std::string name = file->getFilename();
    QPDFObjectHandle stream = file->getEmbeddedFileStream();
    if (!stream.isStream()) throw std::runtime_error("attachment " + name + " has no bytes");
    std::string content = StreamBytes(stream, left);
    left -= content.size();
    if (!attachments.emplace(name, std::move(content)).second)
      throw std::runtime_error("two attachments are named " + name);
  }
  return attachments;
}

std::vector<std::string> PageTextsOf(QPDF& pdf) {
  std::vector<std::string> texts;
  std::size_t total = 0;
  const std::vector<QPDFObjectHandle>& pages = pdf.getAllPages();
  if (pages.empty() || pages.size() > kMostPages)
    throw std::runtime_error("it has " + std::to_string(pages.size()) + " pages, expected 1 to " +
                             std::to_string(kMostPages));
  for (const QPDFObjectHandle& page : pages) {
    texts.push_back(PageText(pdf, page, kMostPageBytes));
    total += texts.back().size();
    if (total > kMostTextBytes) throw std::runtime_error("it has too much text");
  }
  return texts;
}

std::string FirstWarning(QPDF& pdf) {
  const std::vector<QPDFExc> warnings = pdf.getWarnings();
  return warnings.empty() ? "" : warnings.front().getMessageDetail();
}

}  // namespace

Result<PdfContents> ReadPdfContents(const std::string& name, const std::string& bytes) {
  const auto fail = [&](const std::string& reason) {
    return BadInput(name + ": is no undamaged PDF report: " + reason);
  };
  if (!bytes.starts_with("%PDF-")) return fail("it does not begin as a PDF does");
  if (bytes.size() > kMostFileBytes)
    return fail("it has " + std::to_string(bytes.size()) + " bytes, at most " +
                std::to_string(kMostFileBytes) + " are read");
  try {
    QPDF pdf;
    Open(pdf, name, bytes);
    PdfContents contents{AttachmentsOf(pdf), PageTextsOf(pdf)};
    if (const std::string warning = FirstWarning(pdf); !warning.empty()) return fail(warning);
    return contents;
  } catch (const QPDFExc& e) {
    return fail(e.getMessageDetail());
  } catch (const std::exception& e) {
    return fail(e.what());
  }
}

}  // namespace telestrain
