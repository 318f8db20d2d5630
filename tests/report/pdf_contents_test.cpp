// What is read of a PDF report, and that no PDF does harm.
#include "report/reading/pdf_contents.h"

#include <gtest/gtest.h>

#include <memory>
#include <qpdf/Buffer.hh>
#include <qpdf/Pl_Buffer.hh>
#include <qpdf/Pl_Flate.hh>
#include <qpdf/QPDFEmbeddedFileDocumentHelper.hh>

#include "report/edited_pdf.h"
#include "report/pdf_document.h"

namespace telestrain {
namespace {

// Two pages of text, two attachments.
std::string Report() {
  auto pdf = PdfDocument::Create();
  (*pdf)->AddPage();
  (*pdf)->DrawText({}, {50, 700}, "SHA-256 of results.json");
  (*pdf)->DrawText({}, {50, 680}, "张伟 ✓ 227.4 px/mm");
  (*pdf)->AddPage();
  (*pdf)->DrawText({Face::kMono, 8, {}}, {50, 700}, "(a\\b)");
  return EditedPdf(*(*pdf)->Save({}, "seed"), [](QPDF& document) {
    AttachToPdf(document, "results.json", "{\"a\": 1}");
    AttachToPdf(document, "audit.jsonl", std::string("\0\n", 2));
  });
}

TEST(PdfContentsTest, PagesAreReadPieceByPiece) {
  const auto contents = ReadPdfContents("r.pdf", Report());
  ASSERT_TRUE(contents.ok()) << contents.error().message;
  EXPECT_EQ(
      contents->page_texts,
      (std::vector<std::string>{"SHA-256 of results.json\n张伟 ✓ 227.4 px/mm\n", "(a\\b)\n"}));
}

TEST(PdfContentsTest, AttachmentsAreReadByTheirNames) {
  const auto contents = ReadPdfContents("r.pdf", Report());
  ASSERT_TRUE(contents.ok()) << contents.error().message;
  EXPECT_EQ(contents->attachments,
            (std::map<std::string, std::string>{{"results.json", "{\"a\": 1}"},
                                                {"audit.jsonl", std::string("\0\n", 2)}}));
}

TEST(PdfContentsTest, TextOfAnotherKindOfFontIsLeftOut) {
  const std::string bytes = EditedPdf(Report(), [](QPDF& pdf) {
    for (QPDFObjectHandle object : pdf.getAllObjects())
      if (object.isDictionary() && object.getKey("/Subtype").isNameAndEquals("/Type0"))
        object.replaceKey("/Subtype", QPDFObjectHandle::newName("/Type1"));
  });
  const auto contents = ReadPdfContents("r.pdf", bytes);
  ASSERT_TRUE(contents.ok()) << contents.error().message;
  EXPECT_EQ(contents->page_texts, (std::vector<std::string>{"", ""}));
}

TEST(PdfContentsTest, TwoAttachmentsOfOneNameAreRefused) {
  const std::string bytes = EditedPdf(Report(), [](QPDF& pdf) {
    auto stream = QPDFEFStreamObjectHelper::createEFStream(pdf, std::string("other"));
    auto file = QPDFFileSpecObjectHelper::createFileSpec(pdf, "results.json", stream);
    QPDFEmbeddedFileDocumentHelper(pdf).replaceEmbeddedFile("results.json again", file);
  });
  const auto contents = ReadPdfContents("r.pdf", bytes);
  ASSERT_FALSE(contents.ok());
  EXPECT_EQ(contents.error().message,
            "r.pdf: is no undamaged PDF report: two attachments are named results.json");
}

// 300 MB of zeros in a few hundred kilobytes.
std::string Bomb() {
  Pl_Buffer packed("packed");
  Pl_Flate flate("flate", &packed, Pl_Flate::a_deflate);
  std::string block(std::size_t{1} << 20, '\0');
  for (int i = 0; i < 300; ++i)
    flate.write(reinterpret_cast<unsigned char*>(block.data()), block.size());
  flate.finish();
  const std::shared_ptr<Buffer> buffer = packed.getBufferSharedPointer();
  return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

TEST(PdfContentsTest, AStreamThatUnpacksWithoutEndIsRefused) {
  const std::string bomb = Bomb();
  const auto bomb_in = [&](const char* what) {
    return EditedPdf(Report(), [&](QPDF& pdf) {
      QPDFObjectHandle stream =
          std::string(what) == "page"
              ? QPDFObjectHandle(pdf.getAllPages().front()).getKey("/Contents")
              : QPDFEmbeddedFileDocumentHelper(pdf).getEmbeddedFile(what)->getEmbeddedFileStream();
      stream.replaceStreamData(bomb, QPDFObjectHandle::newName("/FlateDecode"),
                               QPDFObjectHandle::newNull());
    });
  };
  for (const char* what : {"page", "results.json"}) {
    const std::string bytes = bomb_in(what);
    ASSERT_LT(bytes.size(), 2000000u);
    const auto contents = ReadPdfContents("r.pdf", bytes);
    ASSERT_FALSE(contents.ok()) << what;
    EXPECT_NE(contents.error().message.find("damaged or too long"), std::string::npos)
        << contents.error().message;
  }
}

TEST(PdfContentsTest, OtherFilesAreRefused) {
  for (const std::string& bytes : {std::string(), std::string("no PDF"), std::string("%PDF-1.7\n")})
    EXPECT_FALSE(ReadPdfContents("r.pdf", bytes).ok());
}

TEST(PdfContentsTest, ACutFileIsRefused) {
  const std::string bytes = Report();
  for (std::size_t size = bytes.size() / 50; size + 8 < bytes.size(); size += bytes.size() / 50)
    EXPECT_FALSE(ReadPdfContents("r.pdf", bytes.substr(0, size)).ok()) << size;
}

// Whatever is read must not be more than the file says, and nothing may crash.
TEST(PdfContentsTest, FlippedBytesAreReadOrRefused) {
  const std::string bytes = Report();
  std::size_t refused = 0, tried = 0;
  for (std::size_t at = 11; at < bytes.size(); at += bytes.size() / 200, ++tried) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x15);
    refused += !ReadPdfContents("r.pdf", changed).ok();
  }
  EXPECT_GT(refused, 0u);
  EXPECT_LE(refused, tried);
}

}  // namespace
}  // namespace telestrain
