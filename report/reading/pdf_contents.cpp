#include "report/reading/pdf_contents.h"

#include <stdexcept>

#include "base/file_limits.h"
#include "report/reading/attached_files.h"
#include "report/reading/classic_pdf.h"
#include "report/reading/page_text.h"

namespace telestrain {
namespace {

// Far more than a report of ours has; a hostile file must not fill the memory.
constexpr std::size_t kMostAttachmentBytes = std::size_t{256} << 20;  // of all together
constexpr std::size_t kMostPageBytes = std::size_t{64} << 20;         // drawing of all pages
constexpr std::size_t kMostPages = 5000;

constexpr const char* kTrail = "audit.jsonl";

void Open(QPDF& pdf, const std::string& name, const std::string& bytes) {
  pdf.setSuppressWarnings(true);
  pdf.setAttemptRecovery(false);  // what has to be guessed is no evidence
  pdf.processMemoryFile(name.c_str(), bytes.data(), bytes.size());
  if (pdf.isEncrypted()) throw std::runtime_error("it is encrypted, which no report of ours is");
}

// Text and rows of all pages.
std::vector<PrintedHash> ReadPages(QPDF& pdf, std::vector<std::string>& texts) {
  std::vector<PrintedHash> rows;
  std::size_t left = kMostPageBytes;
  const std::vector<QPDFObjectHandle>& pages = pdf.getAllPages();
  if (pages.empty() || pages.size() > kMostPages)
    throw std::runtime_error("it has " + std::to_string(pages.size()) + " pages, expected 1 to " +
                             std::to_string(kMostPages));
  for (const QPDFObjectHandle& page : pages) {
    PageText read = ReadPage(pdf, page, left);
    texts.push_back(std::move(read.text));
    rows.insert(rows.end(), read.hashes.begin(), read.hashes.end());
  }
  return rows;
}

// The row behind the trail's is its head, whatever it is called in the report's language.
void TakeHashes(const std::vector<PrintedHash>& rows, PdfContents& contents) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!contents.attachments.contains(rows[i].row)) continue;
    const auto [known, is_new] = contents.printed_hashes.emplace(rows[i].row, rows[i].sha256);
    if (!is_new && known->second != rows[i].sha256)
      throw std::runtime_error("it prints two different SHA-256 of " + rows[i].row);
    const bool head_follows = i + 1 < rows.size() && rows[i].row == kTrail &&
                              !contents.attachments.contains(rows[i + 1].row);
    if (head_follows) contents.printed_head = rows[i + 1].sha256;
  }
}

std::string FirstWarning(QPDF& pdf) {
  const std::vector<QPDFExc> warnings = pdf.getWarnings();
  return warnings.empty() ? "" : warnings.front().getMessageDetail();
}

}  // namespace

Result<PdfContents> ReadPdfContents(const std::string& name, const std::string& bytes) {
  const auto fail = [&](const std::string& reason) {
    return BadInput(name + ": is no undamaged PDF report: " + reason +
                    "; copy it again from where it was made");
  };
  if (bytes.size() > kMostReportBytes)
    return fail("it has " + std::to_string(bytes.size()) + " bytes, at most " +
                std::to_string(kMostReportBytes) + " are read");
  if (const std::string reason = WhyNotClassicPdf(bytes); !reason.empty()) return fail(reason);
  try {
    QPDF pdf;
    Open(pdf, name, bytes);
    PdfContents contents;
    contents.attachments = AttachedFiles(pdf, kMostAttachmentBytes);
    TakeHashes(ReadPages(pdf, contents.page_texts), contents);
    if (const std::string warning = FirstWarning(pdf); !warning.empty()) return fail(warning);
    return contents;
  } catch (const QPDFExc& e) {
    return fail(e.getMessageDetail());
  } catch (const std::exception& e) {
    return fail(e.what());
  }
}

}  // namespace telestrain
