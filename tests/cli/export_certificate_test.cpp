#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

class ExportCertificate : public SessionCopy {
 protected:
  fs::path file() const { return scratch() / "certificate.xml"; }
  ProgramRun RunExport(std::vector<std::string> more) const {
    more.insert(more.begin(), {"export", results().string()});
    return RunTelestrain(more);
  }
  // A report without ruler and strain ends with 1; it is written all the same.
  void MakeReport() const {
    TakeRun({"detect", "calibrate"});
    const ProgramRun run = RunTelestrain({"report", results().string()});
    ASSERT_LE(run.exit_code, 1) << run.err;
  }
};

fs::path SchemaFolder() {
  const char* given = std::getenv("TELESTRAIN_DCC_SCHEMA");
  return given ? given : TELESTRAIN_DCC_SCHEMA_FOLDER;
}

TEST_F(ExportCertificate, IsTheOneOfTheResultsFolder) {
  MakeReport();
  const ProgramRun run = RunExport({"--dcc", file().string()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "export     " + file().string() + "\n");
  EXPECT_EQ(ReadAll(file()), ReadAll(results() / "dcc.xml"));
  EXPECT_NE(ReadAll(file()).find("<dcc:uniqueIdentifier>VE-11 revision 1<"), std::string::npos);
}

TEST_F(ExportCertificate, IsCheckedAgainstTheSchema) {
  if (!fs::exists(SchemaFolder() / "dcc.xsd"))
    GTEST_SKIP() << "the DCC schema is not in " << SchemaFolder()
                 << "; name its folder in TELESTRAIN_DCC_SCHEMA";
  MakeReport();
  const ProgramRun run =
      RunExport({"--dcc", file().string(), "--dcc-schema", SchemaFolder().string()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find(", valid against dcc.xsd in "), std::string::npos) << run.out;
}

// A schema of ours that wants another root element stands for one that the certificate breaks.
TEST_F(ExportCertificate, WhatBreaksTheSchemaIsBadInputWithItsLine) {
  MakeReport();
  const fs::path schema = scratch() / "schema";
  fs::create_directories(schema);
  std::ofstream(schema / "catalog.xml")
      << "<catalog xmlns=\"urn:oasis:names:tc:entity:xmlns:xml:catalog\"/>";
  std::ofstream(schema / "dcc.xsd")
      << "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\"><xs:element name=\"other\" "
         "type=\"xs:string\"/></xs:schema>";
  const ProgramRun run = RunExport({"--dcc", file().string(), "--dcc-schema", schema.string()});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_NE(run.err.find("certificate.xml: line 2: "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("digitalCalibrationCertificate"), std::string::npos) << run.err;
}

TEST_F(ExportCertificate, OfResultsThatWereEditedIsNone) {
  MakeReport();
  std::ofstream(results() / "results.json", std::ios::app) << " ";
  const ProgramRun run = RunExport({"--dcc", file().string()});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("results.json was changed after line"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(ExportCertificate, ComesBesideTheOtherFiles) {
  MakeReport();
  const fs::path out = scratch() / "interchange";
  const ProgramRun run = RunExport({"--dcc", file().string(), "--out", out.string()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(fs::exists(file()));
  EXPECT_TRUE(fs::exists(out / "opencv.yaml"));
}

TEST_F(ExportCertificate, BadRequestsSayWhatToDo) {
  const ProgramRun nothing = RunExport({});
  EXPECT_EQ(nothing.exit_code, 2) << nothing.err;
  EXPECT_NE(nothing.err.find("--dcc FILE"), std::string::npos) << nothing.err;
  const ProgramRun schema = RunExport({"--out", "x", "--dcc-schema", "y"});
  EXPECT_EQ(schema.exit_code, 2) << schema.err;
  TakeRun({"detect", "calibrate"});
  const ProgramRun early = RunExport({"--dcc", file().string()});
  EXPECT_EQ(early.exit_code, 3) << early.err;
  EXPECT_NE(early.err.find("telestrain report"), std::string::npos) << early.err;
  EXPECT_FALSE(fs::exists(file()));
  const std::string before = ReadAll(results() / "calibration.json");
  const ProgramRun over = RunExport({"--dcc", (results() / "calibration.json").string()});
  EXPECT_EQ(over.exit_code, 3) << over.err;
  EXPECT_EQ(ReadAll(results() / "calibration.json"), before);
}

}  // namespace
}  // namespace telestrain::testing_support
