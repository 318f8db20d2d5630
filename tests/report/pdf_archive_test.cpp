// What a file that PdfDocument wrote is as an archive: PDF/A-3a with PDF/UA-1, or PDF/A-1b.

#include <gtest/gtest.h>

#include <fstream>

#include "pdf_sample.h"
#include "pdf_structure_check.h"
#include "pdf_tools.h"
#include "report/table_block.h"
#include "report/unicode_text.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

class PdfArchive : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = TestFolder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string Write(const std::string& bytes) const {
    const std::string path = (folder_ / "sample.pdf").string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  std::filesystem::path folder_;
};

std::string Joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

TEST_F(PdfArchive, IsAWellFormedFileOfItsVersion) {
  NEEDS_TOOL(TELESTRAIN_TOOL_QPDF, "qpdf");
  for (const ArchiveLevel level : {ArchiveLevel::k3a, ArchiveLevel::k1b}) {
    const std::string bytes = SamplePdf(level);
    const ToolRun check =
        RunTool(std::string(TELESTRAIN_TOOL_QPDF) + " --check '" + Write(bytes) + "'");
    EXPECT_TRUE(check.ok) << check.output;
    EXPECT_EQ(bytes.substr(0, 9), level == ArchiveLevel::k3a ? "%PDF-1.7\n" : "%PDF-1.4\n");
    // A comment of four bytes above 127 says that the file is binary (ISO 19005-1, 6.1.2).
    EXPECT_EQ(bytes[9], '%');
    for (std::size_t i = 10; i < 14; ++i) EXPECT_GT(static_cast<unsigned char>(bytes[i]), 127);
  }
}

TEST_F(PdfArchive, TagsAreComplete) {
  EXPECT_EQ(Joined(StructureFaults(SamplePdf(ArchiveLevel::k3a))), "");
}

// The check sees what it should: every damage of a good file is a fault.
TEST_F(PdfArchive, DamagedTagsAreSeen) {
  const std::string good = SamplePdf(ArchiveLevel::k3a);
  const std::vector<std::pair<std::string, std::string>> damages = {
      {"/Scope /Row", "/Scope /Raw"},
      {"/S /TD", "/S /TH"},
      {"/S /H2", "/S /H5"},
      {"/Block\n/BBox [", "/Block\n/BBax ["},
      {"/Alt", "/Olt"},
      {"/StructParent 3", "/StructParent 1"},
      {"/Tabs /S", "/Tabs /R"},
      {"/StructParents 1", "/StructParents 0"},
      {"/S /Link", "/S /Span"},
      {"/Contents (", "/Cantents ("},
      {"/TU (", "/TV ("},
      {"/F 4", "/F 2"},
      {"/Marked true", "/Morked true"}};
  for (const auto& [from, to] : damages) {
    std::string bad = good;
    const std::size_t at = bad.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    bad.replace(at, from.size(), to);
    EXPECT_FALSE(StructureFaults(bad).empty()) << from;
  }
}

TEST_F(PdfArchive, HeadingsCloseUpWhateverTheLayoutSays) {
  auto pdf = PdfDocument::Create().value();
  pdf->AddPage();
  for (const char* type : {"H3", "H3", "H6", "H2", "H4", "H1", "H3"}) {
    const ScopedTag heading(*pdf, PdfTag{type});
    pdf->DrawText({}, {100, 700}, type);
  }
  const std::string bytes = pdf->Save({}, "").value();
  EXPECT_EQ(Joined(StructureFaults(bytes)), "");
  std::string levels;
  for (std::size_t at = bytes.find("/S /H"); at != std::string::npos;
       at = bytes.find("/S /H", at + 1))
    levels += bytes[at + 5];
  EXPECT_EQ(levels, "1121212");
}

TEST_F(PdfArchive, AnEmptyTagAndALinkToNowhereLeaveNoTrace) {
  auto pdf = PdfDocument::Create().value();
  pdf->AddPage();
  {
    const ScopedTag heading(*pdf, PdfTag{"H1"});
    pdf->DrawText({}, {100, 700}, "Title");
  }
  { const ScopedTag empty(*pdf, PdfTag{"P"}); }
  {
    const ScopedTag paragraph(*pdf, PdfTag{"P"});
    const ScopedTag link(*pdf, PdfTag{"Link", "nowhere"});
    pdf->DrawText({}, {100, 600}, "a link");
    pdf->AddLink({100, 598, 40, 12}, "nowhere");
  }
  const std::string bytes = pdf->Save({}, "").value();
  EXPECT_EQ(Joined(StructureFaults(bytes)), "");
  EXPECT_EQ(bytes.find("/Annot"), std::string::npos);
  EXPECT_EQ(bytes.find("/S /Link"), std::string::npos);
  EXPECT_NE(bytes.find("/S /Span"), std::string::npos);
}

// 80 rows over several pages, the first linked: tags stay in order, headers are not read twice.
TEST_F(PdfArchive, ALongTableIsOneTableWithLinks) {
  Json table = {{"title", "Long"},
                {"columns", {{{"name", "Row"}, {"unit", ""}}, {{"name", "Value"}, {"unit", "px"}}}},
                {"row_links", {"there", {{"link", "there"}}, {{"link", "nowhere"}}, nullptr}}};
  for (int i = 0; i < 80; ++i)
    table["rows"].push_back({"row " + std::to_string(i), i % 7 == 0 ? Json("") : Json("1.5")});
  table["rows"][40][1] = std::string(9000, 'x');  // a row that is cut over pages
  auto pdf = PdfDocument::Create().value();
  PageFlow flow(*pdf, Look{});
  flow.StartPage();
  pdf->AddDestination("there", flow.y_pt());
  flow.Paragraph(flow.look().Strong(), "Title", {"H1"});
  DrawTable(flow, table, {});
  EXPECT_GT(pdf->PageCount(), 2);
  const std::string bytes = pdf->Save({}, "").value();
  EXPECT_EQ(Joined(StructureFaults(bytes)), "");
  const auto count = [&](const std::string& wanted) {
    int found = 0;
    for (std::size_t at = bytes.find(wanted); at != std::string::npos;
         at = bytes.find(wanted, at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(count("/S /Table\n"), 1);
  EXPECT_EQ(count("/S /TR\n"), 81);
  EXPECT_EQ(count("/S /Link\n"), 2);
  EXPECT_EQ(count("/Scope /Column"), 2);
}

TEST_F(PdfArchive, MetadataSaysTheSameInBothPlaces) {
  PdfInfo info = SampleInfo();
  info.title = " <Prüfbericht> & 测量 \x01 \xF0\x9F\x98\x80\xEF\xBF\xBE ";
  for (const ArchiveLevel level : {ArchiveLevel::k3a, ArchiveLevel::k1b}) {
    const std::string bytes = SamplePdf(level, info);
    const std::string xmp = XmpOf(bytes);
    for (const auto& [name, key] : {std::pair("dc:title", "Title"),
                                    {"dc:creator", "Author"},
                                    {"dc:description", "Subject"},
                                    {"pdf:Keywords", "Keywords"},
                                    {"pdf:Producer", "Producer"},
                                    {"xmp:CreatorTool", "Creator"}}) {
      EXPECT_FALSE(InfoEntry(bytes, key).empty()) << key;
      EXPECT_EQ(XmpValue(xmp, name), InfoEntry(bytes, key)) << key;
    }
    EXPECT_EQ(InfoEntry(bytes, "Title"), "<Prüfbericht> & 测量   \xF0\x9F\x98\x80\xEF\xBF\xBD");
    EXPECT_EQ(InfoEntry(bytes, "CreationDate"), "D:20260131101500Z");
    EXPECT_EQ(InfoEntry(bytes, "ModDate"), "D:20260131101500Z");
    for (const char* name : {"xmp:CreateDate", "xmp:ModifyDate"})
      EXPECT_EQ(XmpValue(xmp, name), "2026-01-31T10:15:00Z");
    EXPECT_EQ(XmpValue(xmp, "pdfaid:part"), level == ArchiveLevel::k3a ? "3" : "1");
    EXPECT_EQ(XmpValue(xmp, "pdfaid:conformance"), level == ArchiveLevel::k3a ? "A" : "B");
    EXPECT_EQ(XmpValue(xmp, "pdfuaid:part"), level == ArchiveLevel::k3a ? "1" : "");
  }
}

TEST_F(PdfArchive, WithoutADateThereIsNone) {
  PdfInfo info = SampleInfo();
  info.created.clear();
  const std::string bytes = SamplePdf(ArchiveLevel::k3a, info);
  EXPECT_EQ(bytes.find("Date"), std::string::npos);
}

TEST_F(PdfArchive, PacketIsWellFormedXml) {
  NEEDS_TOOL(TELESTRAIN_TOOL_XMLLINT, "xmllint");
  const std::string path = (folder_ / "packet.xml").string();
  std::ofstream(path) << XmpOf(SamplePdf(ArchiveLevel::k3a));
  const ToolRun run = RunTool(std::string(TELESTRAIN_TOOL_XMLLINT) + " --noout '" + path + "'");
  EXPECT_TRUE(run.ok) << run.output;
}

TEST_F(PdfArchive, AttachmentsComeOutByteByByte) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFDETACH, "pdfdetach");
  const std::string path = Write(SamplePdf(ArchiveLevel::k3a));
  const ToolRun run = RunTool(std::string(TELESTRAIN_TOOL_PDFDETACH) + " -saveall -o '" +
                              folder_.string() + "' '" + path + "'");
  EXPECT_TRUE(run.ok) << run.output;
  ASSERT_EQ(SampleAttachments().size(), 3u);
  for (const PdfAttachment& attachment : SampleAttachments())
    EXPECT_EQ(FileBytes((folder_ / attachment.name).string()), attachment.bytes);
}

TEST_F(PdfArchive, TheTextIsTheOneThatWasDrawn) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  for (const ArchiveLevel level : {ArchiveLevel::k3a, ArchiveLevel::k1b}) {
    const std::string text = RunTool(std::string(TELESTRAIN_TOOL_PDFTOTEXT) + " -enc UTF-8 '" +
                                     Write(SamplePdf(level)) + "' -")
                                 .output;
    for (const std::string& line : SampleLines())
      EXPECT_NE(("\n" + text).find("\n" + line + "\n"), std::string::npos) << line << "\n" << text;
  }
}

// PDF/UA-1 7.21.8: no code may show the missing glyph; 7.21.7: nor stand for U+FEFF and the like.
TEST_F(PdfArchive, CharactersWithoutMeaningAreNamed) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  auto pdf = PdfDocument::Create().value();
  pdf->AddPage();
  pdf->DrawText({}, {100, 700},
                "\xEF\xBB\xBF"
                "a\xEE\x80\x80"
                "b\xEF\xBF\xBE");
  const std::string text = RunTool(std::string(TELESTRAIN_TOOL_PDFTOTEXT) + " '" +
                                   Write(pdf->Save({}, "").value()) + "' -")
                               .output;
  EXPECT_NE(text.find("[U+FEFF]a[U+E000]b[U+FFFE]"), std::string::npos) << text;
}

// Glyphs of DejaVu that are put together from glyphs that are put together themselves. Where all
// parts are drawn as characters of their own too, libharu has them all.
TEST_F(PdfArchive, GlyphsOfGlyphsOfGlyphsAreWhole) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOPPM, "pdftoppm");
  const auto first_page = [this](const std::string& text, char32_t from, char32_t to) {
    auto pdf = PdfDocument::Create().value();
    pdf->AddPage();
    pdf->DrawText({Face::kRegular, 40, {}}, {60, 600}, text);
    pdf->AddPage();
    for (char32_t c = from; c < to; ++c) pdf->DrawText({}, {60, 600}, Utf8(c));
    const std::string path = Write(pdf->Save({}, "").value());
    const std::string picture = (folder_ / "page").string();
    RunTool(std::string(TELESTRAIN_TOOL_PDFTOPPM) + " -r 50 -l 1 -singlefile '" + path + "' '" +
            picture + "'");
    return FileBytes(picture + ".ppm");
  };
  for (const auto& [text, from, to] :
       {std::tuple("\u4DC7\u4DD6", U'\u4DC0', U'\u4E00'), {"\u1402\u1414\u144E", 0x1400, 0x1500}}) {
    const std::string alone = first_page(text, 0, 0);
    EXPECT_NE(alone, first_page(" ", 0, 0));
    EXPECT_EQ(alone, first_page(text, from, to));
  }
}

TEST_F(PdfArchive, TheSameCallsGiveTheSameBytes) {
  for (const ArchiveLevel level : {ArchiveLevel::k3a, ArchiveLevel::k1b})
    EXPECT_EQ(SamplePdf(level), SamplePdf(level));
  EXPECT_NE(SamplePdf(ArchiveLevel::k3a), SamplePdf(ArchiveLevel::k1b));
}

// /ID is made of what the file holds: another picture, another identifier.
TEST_F(PdfArchive, TheIdentifierIsThatOfTheContent) {
  const auto id = [](const std::string& bytes) {
    const std::size_t at = bytes.rfind("/ID [ <");
    return at == std::string::npos ? "" : bytes.substr(at + 7, 32);
  };
  PdfInfo other = SampleInfo();
  other.author = "another";
  const std::string first = id(SamplePdf(ArchiveLevel::k3a));
  EXPECT_EQ(first.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(first, std::string(32, '0'));
  EXPECT_NE(first, id(SamplePdf(ArchiveLevel::k3a, other)));
}

TEST_F(PdfArchive, TheVariantForPdfA1HasNothingOfLaterVersions) {
  const std::string bytes = SamplePdf(ArchiveLevel::k1b);
  for (const char* key : {"/EmbeddedFile", "/AF", "/AcroForm", "/StructTreeRoot", "/MarkInfo",
                          "/SMask", "/ExtGState", "/Group", "/LZWDecode"})
    EXPECT_EQ(bytes.find(key), std::string::npos) << key;
  EXPECT_NE(bytes.find("/CIDSet"), std::string::npos);
  EXPECT_EQ(SamplePdf(ArchiveLevel::k3a).find("/CIDSet"), std::string::npos);
}

TEST_F(PdfArchive, TheVariantForPdfA1PassesPreflight) {
  const std::string command = PreflightCommand();
  if (command.empty()) GTEST_SKIP() << "java or the PDFBox preflight jars are not installed";
  const ToolRun run = RunTool(command + " '" + Write(SamplePdf(ArchiveLevel::k1b)) + "'");
  EXPECT_NE(run.output.find("is a valid PDF/A-1b file"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace telestrain
