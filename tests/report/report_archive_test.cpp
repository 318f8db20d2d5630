// The reports of a results folder and of a study as archives.

#include <gtest/gtest.h>

#include <fstream>

#include "base/files.h"
#include "base/json_file.h"
#include "pdf_structure_check.h"
#include "pdf_tools.h"
#include "report/acceptance_report.h"
#include "report/study_report.h"
#include "results_fixture.h"
#include "study_fixture.h"

namespace telestrain {
namespace {

class ReportArchive : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = TestFolder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    fixture_ = PlausibleResults();
    WriteResults(fixture_, folder_);
    ASSERT_TRUE(MakeResults(folder_));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string Make(ArchiveLevel level = ArchiveLevel::k3a) {
    ReportOptions options;
    options.level = level;
    const Status written = WriteReport(folder_, options);
    EXPECT_TRUE(written) << written.error().message;
    return FileBytes(Pdf());
  }
  std::string Pdf() const { return (folder_ / "report.pdf").string(); }

  std::filesystem::path folder_;
  ResultsFixture fixture_;
};

std::string Joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

TEST_F(ReportArchive, TagsAreComplete) { EXPECT_EQ(Joined(StructureFaults(Make())), ""); }

TEST_F(ReportArchive, TagsAreCompleteWithHardlyAnything) {
  fixture_.ruler = fixture_.strain = fixture_.calibration = fixture_.detection = nullptr;
  fixture_.pictures = false;
  WriteResults(fixture_, folder_);
  ASSERT_TRUE(MakeResults(folder_));
  EXPECT_EQ(Joined(StructureFaults(Make())), "");
}

TEST_F(ReportArchive, TagsOfAStudyAreComplete) {
  WritePicture(folder_ / "board.png", 640, 480);
  ASSERT_TRUE(WriteJson(folder_ / "study.json", SampleStudy()));
  ASSERT_TRUE(WriteStudyReport(folder_ / "study.json", folder_ / "study.pdf"));
  EXPECT_EQ(Joined(StructureFaults(FileBytes((folder_ / "study.pdf").string()))), "");
}

TEST_F(ReportArchive, TheVariantForPdfA1PassesPreflight) {
  const std::string command = PreflightCommand();
  if (command.empty()) GTEST_SKIP() << "java or the PDFBox preflight jars are not installed";
  Make(ArchiveLevel::k1b);
  const ToolRun run = RunTool(command + " '" + Pdf() + "'");
  EXPECT_NE(run.output.find("is a valid PDF/A-1b file"), std::string::npos) << run.output;
}

// The same pages, whatever the level: the signature fields have no looks of their own.
TEST_F(ReportArchive, BothLevelsHaveTheSamePages) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOPPM, "pdftoppm");
  std::vector<std::string> pictures[2];
  for (const int i : {0, 1}) {
    Make(i == 0 ? ArchiveLevel::k3a : ArchiveLevel::k1b);
    const std::string prefix = (folder_ / ("level" + std::to_string(i))).string();
    ASSERT_TRUE(
        RunTool(std::string(TELESTRAIN_TOOL_PDFTOPPM) + " -r 30 '" + Pdf() + "' '" + prefix + "'")
            .ok);
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name.rfind("level" + std::to_string(i), 0) == 0)
        pictures[i].push_back(name.substr(6) + Sha256Hex(FileBytes(entry.path().string())));
    }
    std::sort(pictures[i].begin(), pictures[i].end());
  }
  EXPECT_GT(pictures[0].size(), 5u);
  EXPECT_EQ(pictures[0], pictures[1]);
}

TEST_F(ReportArchive, CarriesTheFilesOfTheFolder) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFDETACH, "pdfdetach");
  std::ofstream(folder_ / "session.toml") << "name = \"测试\"\n";
  std::ofstream(folder_ / "dcc.xml") << "<dcc/>\n";
  Make();
  const auto out = folder_ / "out";
  std::filesystem::create_directories(out);
  ASSERT_TRUE(RunTool(std::string(TELESTRAIN_TOOL_PDFDETACH) + " -saveall -o '" + out.string() +
                      "' '" + Pdf() + "'")
                  .ok);
  for (const char* name : {"results.json", "calibration.json", "session.toml", "dcc.xml"}) {
    const std::string bytes = FileBytes((folder_ / name).string());
    EXPECT_FALSE(bytes.empty()) << name;
    EXPECT_EQ(FileBytes((out / name).string()), bytes) << name;
  }
}

TEST_F(ReportArchive, HasAFieldForEveryoneWhoSigns) {
  const std::string bytes = Make();
  for (const char* field : {"/T (operator)", "/T (reviewer)", "/T (approver)", "/T (instrument)"})
    EXPECT_NE(bytes.find(field), std::string::npos) << field;
}

}  // namespace
}  // namespace telestrain
