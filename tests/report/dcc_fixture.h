#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "base/json_file.h"
#include "dcc_reader.h"
#include "pdf_tools.h"
#include "report/acceptance_report.h"
#include "report/dcc/dcc.h"
#include "results_fixture.h"

namespace telestrain {

// The schema is not ours to pass on; where it lies is an option.
inline std::filesystem::path SchemaFolder() {
  const char* given = std::getenv("TELESTRAIN_DCC_SCHEMA");
  return given ? given : TELESTRAIN_DCC_SCHEMA_FOLDER;
}

#define NEEDS_SCHEMA()                                          \
  if (!std::filesystem::exists(SchemaFolder() / "dcc.xsd"))     \
  GTEST_SKIP() << "the DCC schema is not in " << SchemaFolder() \
               << "; name its folder in TELESTRAIN_DCC_SCHEMA"

// A results folder and its certificate.
class Dcc : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = TestFolder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    fixture_ = PlausibleResults();
    fixture_.pictures = false;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // dcc.xml of the fixture; `results_` is the results.json beside it.
  std::string Make() {
    WriteResults(fixture_, folder_);
    const auto outcome = MakeResults(folder_);
    EXPECT_TRUE(outcome) << outcome.error().message;
    auto results = ReadJson(folder_ / "results.json", "telestrain.results/1", "test");
    EXPECT_TRUE(results);
    results_ = results ? *results : Json();
    return FileBytes(folder_ / "dcc.xml");
  }
  void ExpectValid(const std::string& xml) const {
    const Status valid = ValidateDcc("dcc.xml", xml, SchemaFolder());
    EXPECT_TRUE(valid) << valid.error().message;
    if (std::string(TELESTRAIN_TOOL_XMLLINT).empty()) return;
    std::ofstream(folder_ / "copy.xml", std::ios::binary) << xml;
    const std::filesystem::path schema = SchemaFolder();
    const ToolRun run =
        RunTool("XML_CATALOG_FILES='" + (schema / "catalog.xml").string() + "' " +
                TELESTRAIN_TOOL_XMLLINT + " --nonet --noout --schema '" +
                (schema / "dcc.xsd").string() + "' '" + (folder_ / "copy.xml").string() + "'");
    EXPECT_TRUE(run.ok) << run.output;
  }

  std::filesystem::path folder_;
  ResultsFixture fixture_;
  Json results_;
};

}  // namespace telestrain
