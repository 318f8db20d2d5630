#include <algorithm>

#include "report/audit/report_check.h"
#include "report/reading/classic_pdf.h"
#include "report/reading/pdf_contents.h"
#include "report/signature/integrity.h"
#include "report/signature/signed_layout.h"
#include "robustness/fuzz/fuzz_target.h"

namespace telestrain::fuzz {
namespace {

// The number of "12 0 obj" at `at`, 0 when no object begins there.
int ObjectAt(std::string_view bytes, std::size_t at) {
  std::size_t end = at;
  int number = 0;
  while (end < bytes.size() && end < at + 5 && bytes[end] >= '0' && bytes[end] <= '9')
    number = 10 * number + (bytes[end++] - '0');
  return end > at && bytes.substr(end, 6) == " 0 obj" ? number : 0;
}

// Bytes that end before their cross-reference table get the one that fits: changed bytes rarely
// have a right one, and then no reader looks further. Object 1 is the root.
std::string WithTable(std::string bytes) {
  std::map<int, std::size_t> offsets;
  for (std::size_t at = 0; at < bytes.size(); at = std::min(bytes.find('\n', at), bytes.size()) + 1)
    if (const int number = ObjectAt(bytes, at)) offsets[number] = at;
  const std::size_t table = bytes.size();
  bytes += "xref\n0 1\n0000000000 65535 f \n";
  for (const auto& [number, offset] : offsets) {
    const std::string digits = std::to_string(offset);
    bytes += std::to_string(number) + " 1\n" +
             std::string(10 - std::min<std::size_t>(10, digits.size()), '0') + digits +
             " 00000 n \n";
  }
  const int size = offsets.empty() ? 1 : offsets.rbegin()->first + 1;
  return bytes + "trailer\n<< /Size " + std::to_string(size) +
         " /Root 1 0 R /ID [<00112233445566778899aabbccddeeff><00112233445566778899aabbccddeeff>] "
         ">>\nstartxref\n" +
         std::to_string(table) + "\n%%EOF\n";
}

void TryPdf(const std::string& bytes) {
  const auto contents = ReadPdfContents("report.pdf", bytes);
  Require(WhyNotClassicPdf(bytes).empty() || !contents.ok(),
          "a PDF that is not built as ours is not read");
  Succeeds(contents);
  Succeeds(CheckReport("report.pdf", bytes, {}, nullptr));
  const SignedLayout layout = ReadSignedLayout(bytes);
  const SignatureCheck check = CheckIntegrity(bytes, nullptr);
  Require(layout.failure.empty() || !check.failure.empty(), "a wrong layout is no valid signature");
  if (check.failure.empty() && !check.signatures.empty())
    Require(check.signatures.back().signed_bytes == bytes.size(),
            "the last signature covers the whole file");
}

}  // namespace

void FuzzPdf(std::string_view input) {
  const std::string bytes(input);
  TryPdf(bytes.find("startxref") == std::string::npos ? WithTable(bytes) : bytes);
}

}  // namespace telestrain::fuzz
