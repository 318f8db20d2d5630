// What is read of a PDF report, and that no PDF does harm.
#include "report/reading/pdf_contents.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <qpdf/Buffer.hh>
#include <qpdf/Pl_Buffer.hh>
#include <qpdf/Pl_Flate.hh>
#include <qpdf/QPDFEmbeddedFileDocumentHelper.hh>
#include <qpdf/QPDFWriter.hh>

#include "report/edited_pdf.h"
#include "report/pdf_document.h"
#include "report/reading/classic_pdf.h"

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

std::string Refusal(const std::string& bytes) {
  const auto contents = ReadPdfContents("r.pdf", bytes);
  const std::string prefix = "r.pdf: is no undamaged PDF report: ";
  if (contents.ok()) return "read";
  const std::string remedy = "; copy it again from where it was made";
  const std::string& message = contents.error().message;
  if (!message.starts_with(prefix) || !message.ends_with(remedy)) return message;
  return message.substr(prefix.size(), message.size() - prefix.size() - remedy.size());
}
std::string Refusal(const std::function<void(QPDF&)>& change) {
  return Refusal(EditedPdf(Report(), change));
}

TEST(PdfContentsTest, TextOfAnotherKindOfFontIsRefused) {
  EXPECT_EQ(Refusal([](QPDF& pdf) {
              for (QPDFObjectHandle object : pdf.getAllObjects())
                if (object.isDictionary() && object.getKey("/Subtype").isNameAndEquals("/Type0"))
                  object.replaceKey("/Subtype", QPDFObjectHandle::newName("/Type1"));
            }),
            "a page of it has a font of another kind than ours");
}

const std::string kHash(64, 'a');

// What is printed of results.json on a page that `draw` draws.
std::string PrintedOn(const std::function<void(PdfDocument&)>& draw) {
  auto pdf = PdfDocument::Create();
  (*pdf)->AddPage();
  draw(**pdf);
  (*pdf)->Attach({"results.json", "application/json", "", "Data", "{}"});
  const auto contents = ReadPdfContents("r.pdf", *(*pdf)->Save({}, "seed"));
  EXPECT_TRUE(contents.ok()) << contents.error().message;
  if (!contents.ok()) return "";
  const auto found = contents->printed_hashes.find("results.json");
  return found == contents->printed_hashes.end() ? "" : found->second;
}
void DrawRow(PdfDocument& pdf, const TextStyle& style, double y_pt = 500, double x_pt = 200) {
  pdf.DrawText({}, {50, 500}, "results.json");
  pdf.DrawText(style, {x_pt, y_pt}, kHash);
}
constexpr Color kWhite{1, 1, 1}, kBlack{0, 0, 0};
const TextStyle kMono{Face::kMono, 8, kBlack};
constexpr PageBox kRow{40, 495, 500, 20};

TEST(PdfContentsTest, AHashCountsWhereItStandsInTheRowOfItsFile) {
  EXPECT_EQ(PrintedOn([](PdfDocument& pdf) { DrawRow(pdf, kMono); }), kHash);
  EXPECT_EQ(PrintedOn([](PdfDocument& pdf) { DrawRow(pdf, kMono, 501); }), kHash);
  EXPECT_EQ(PrintedOn([](PdfDocument& pdf) { DrawRow(pdf, kMono, 503); }), "");
}

TEST(PdfContentsTest, AHashThatNobodySeesDoesNotCount) {
  const auto hidden = [](const std::function<void(PdfDocument&)>& draw) {
    return PrintedOn(draw).empty();
  };
  EXPECT_TRUE(hidden([](PdfDocument& pdf) { DrawRow(pdf, {Face::kMono, 8, kWhite}); }));
  EXPECT_TRUE(hidden([](PdfDocument& pdf) { DrawRow(pdf, {Face::kMono, 3.9, kBlack}); }));
  EXPECT_TRUE(hidden([](PdfDocument& pdf) { DrawRow(pdf, kMono, 500, 600); }));
  EXPECT_TRUE(hidden([](PdfDocument& pdf) {
    pdf.BeginClip({0, 0, 100, 100});
    DrawRow(pdf, kMono);
    pdf.EndClip();
  }));
  EXPECT_TRUE(hidden([](PdfDocument& pdf) {
    pdf.FillBox(kRow, kBlack);
    DrawRow(pdf, kMono);
  }));
  EXPECT_TRUE(hidden([](PdfDocument& pdf) {
    DrawRow(pdf, kMono);
    pdf.FillBox(kRow, kWhite);
  }));
  EXPECT_TRUE(hidden([](PdfDocument& pdf) {
    DrawRow(pdf, kMono);
    pdf.DrawPolyline({{100, 503}, {550, 503}}, {kWhite, 12});
  }));
  EXPECT_TRUE(hidden([](PdfDocument& pdf) {
    DrawRow(pdf, kMono);
    pdf.DrawText({Face::kMono, 8, kWhite}, {200, 500}, std::string(64, 'b'));
  }));
}

TEST(PdfContentsTest, WhiteOnDarkIsSeen) {
  EXPECT_EQ(PrintedOn([](PdfDocument& pdf) {
              pdf.DrawText({}, {50, 500}, "results.json");
              pdf.FillBox({190, 495, 350, 20}, kBlack);
              pdf.DrawText({Face::kMono, 8, kWhite}, {200, 500}, kHash);
            }),
            kHash);
}

TEST(PdfContentsTest, OperatorsOfOthersAreRefused) {
  for (const char* invisible : {"3 Tr", "1 Tz", "/G gs", "BI"})
    EXPECT_NE(Refusal([&](QPDF& pdf) {
                QPDFObjectHandle page = pdf.getAllPages().front();
                auto before = QPDFObjectHandle::newStream(&pdf, std::string(invisible) + " ");
                page.replaceKey("/Contents",
                                QPDFObjectHandle::newArray({before, page.getKey("/Contents")}));
              }).find("which no report of ours does"),
              std::string::npos)
        << invisible;
}

QPDFObjectHandle ListOf(QPDF& pdf) {
  return pdf.getRoot().getKey("/Names").getKey("/EmbeddedFiles").getKey("/Names");
}

// Whichever entry a reader follows, it must find the same bytes.
TEST(PdfContentsTest, AttachmentsThatDependOnTheReaderAreRefused) {
  EXPECT_EQ(Refusal([](QPDF& pdf) {
              auto stream = QPDFEFStreamObjectHelper::createEFStream(pdf, std::string("other"));
              ListOf(pdf).getArrayItem(3).getKey("/EF").replaceKey("/F", stream.getObjectHandle());
            }),
            "attachment results.json has other bytes for other readers");
  EXPECT_EQ(Refusal([](QPDF& pdf) {
              ListOf(pdf).getArrayItem(3).replaceKey("/F", QPDFObjectHandle::newUnicodeString("x"));
            }),
            "attachment results.json has another name too");
  EXPECT_EQ(Refusal([](QPDF& pdf) {
              QPDFObjectHandle list = ListOf(pdf);
              list.setArrayItem(0, list.getArrayItem(2));
            }),
            "attachment results.json has another name too");
  EXPECT_EQ(Refusal([](QPDF& pdf) {
              QPDFObjectHandle list = ListOf(pdf);
              list.appendItem(list.getArrayItem(2));
              list.appendItem(list.getArrayItem(3));
            }),
            "two attachments are named results.json");
  EXPECT_EQ(Refusal([](QPDF& pdf) { pdf.getRoot().getKey("/AF").eraseItem(0); }),
            "its associated files are not its attachments");
  EXPECT_EQ(Refusal([](QPDF& pdf) {
              auto note = QPDFObjectHandle::parse(
                  "<< /Type /Annot /Subtype /FileAttachment /Rect [0 0 9 9] >>");
              QPDFObjectHandle(pdf.getAllPages().front())
                  .replaceKey("/Annots", QPDFObjectHandle::newArray({note}));
            }),
            "a page of it has an annotation that is neither a link nor a field");
}

// Object streams may unpack to any size before anything can be asked of them.
TEST(PdfContentsTest, AFileWithoutPlainCrossReferenceTablesIsRefused) {
  const std::string bytes = Report();
  EXPECT_EQ(WhyNotClassicPdf(bytes), "");
  QPDF pdf;
  pdf.processMemoryFile("r.pdf", bytes.data(), bytes.size());
  QPDFWriter writer(pdf);
  writer.setOutputMemory();
  writer.setObjectStreamMode(qpdf_o_generate);
  writer.write();
  const std::shared_ptr<Buffer> buffer = writer.getBufferSharedPointer();
  EXPECT_EQ(Refusal({reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()}),
            "it has a place without a plain cross-reference table, which ours have");
  std::string hybrid = bytes;
  hybrid.insert(hybrid.rfind(">>"), "/XRefStm 15 ");
  EXPECT_EQ(Refusal(hybrid), "its trailer is not as ours are");
  std::string endless = bytes;
  const std::string start = bytes.substr(bytes.rfind("startxref") + 10);
  endless.insert(endless.rfind(">>"), "/Prev " + start.substr(0, start.find('\n')) + " ");
  EXPECT_EQ(Refusal(endless), "its cross-reference tables have no end");
}

// Many small streams are as long as one large one.
TEST(PdfContentsTest, TheLimitIsThatOfAllPagesTogether) {
  EXPECT_EQ(Refusal([](QPDF& pdf) {
              auto blanks = QPDFObjectHandle::newStream(&pdf, std::string(20 << 20, ' '));
              for (QPDFObjectHandle page : pdf.getAllPages())
                page.replaceKey("/Contents", QPDFObjectHandle::newArray({blanks, blanks}));
            }),
            "a stream of it is damaged or too long");
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
