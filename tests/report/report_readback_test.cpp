#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "base/numbers.h"
#include "cli/kept_run.h"
#include "dcc_reader.h"
#include "pdf_tools.h"
#include "report_reading.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// One message per case, so that a report with many faults names them all in few lines.
std::string Lines(const std::vector<std::string>& missing) {
  std::string lines = std::to_string(missing.size()) + " missing";
  for (std::size_t i = 0; i < missing.size() && i < 10; ++i) lines += "\n  " + missing[i];
  return lines;
}

class ReportReadback : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = TestFolder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void WriteFixture() const {
    ResultsFixture fixture = PlausibleResults();
    WriteResults(fixture, folder_);
  }
  // The committed session through the program itself.
  void RunSmallSession() const {
    const auto kept = testing_support::KeptRunOf({"run"});
    ASSERT_EQ(kept.run.exit_code, 0) << kept.run.err;
    fs::copy(kept.folder / "results", folder_, fs::copy_options::recursive);
  }
  void ExpectEverythingPrinted() const {
    for (const ReportCase& report : AllReportCases()) {
      SCOPED_TRACE(NameOf(report));
      MakeReport(folder_, report);
      const Json results = ReadResults(folder_);
      const ReportTemplate layout = TemplateOf(report);
      const std::string drawn = DrawnText(folder_);
      const auto rows = MissingOfTables(results, layout, drawn);
      EXPECT_TRUE(rows.empty()) << Lines(rows);
      const auto quantities = MissingOfQuantities(results, layout, drawn);
      EXPECT_TRUE(quantities.empty()) << Lines(quantities);
    }
  }
  void ExpectTheSameNumbers() const;

  fs::path folder_;
};

TEST_F(ReportReadback, EveryNumberOfTheFixtureStandsInEveryReport) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  WriteFixture();
  ExpectEverythingPrinted();
}

TEST_F(ReportReadback, EveryNumberOfARealRunStandsInEveryReport) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  RunSmallSession();
  ExpectEverythingPrinted();
}

// All tables of the results are in the layout of everything; those of a single measurand's budget
// stand together in the table "budget", and "idics" says what "correlation" does.
TEST_F(ReportReadback, NoTableIsLeftOutOfTheAcceptanceReport) {
  WriteFixture();
  MakeReport(folder_, {"acceptance", "en"});
  const ReportTemplate layout = TemplateOf({"acceptance", "en"});
  std::set<std::string> drawn;
  for (const Json& block : layout.blocks()) drawn.insert(TextAt(block, "/table"));
  const Json results = ReadResults(folder_);
  for (const Json& table : ListAt(results, "/tables")) {
    const std::string id = TextAt(table, "/id");
    const std::string shown_in = id.ends_with("-budget") ? "budget"
                                 : id == "correlation"   ? "idics"
                                                         : id;
    EXPECT_EQ(drawn.count(shown_in), 1u) << id;
  }
}

// The check must see a number that differs in its last digit, a unit and a verdict.
TEST_F(ReportReadback, ADifferingNumberIsFound) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  WriteFixture();
  MakeReport(folder_, {"acceptance", "en"});
  const Json results = ReadResults(folder_);
  const ReportTemplate layout = TemplateOf({"acceptance", "en"});
  const std::string drawn = DrawnText(folder_);
  Json other = results;
  other["quantities"][0]["printed"] = "0.9438";
  EXPECT_EQ(MissingOfQuantities(other, layout, drawn).size(), 2u);
  other = results;
  other["quantities"][0]["unit"] = "mm";
  EXPECT_EQ(MissingOfQuantities(other, layout, drawn).size(), 1u);
  other = results;
  other["quantities"][0]["verdict"] = "fail";
  EXPECT_EQ(MissingOfQuantities(other, layout, drawn).size(), 1u);
  other = results;
  for (Json& table : other["tables"])
    if (TextAt(table, "/id") == "ruler") table["rows"][3][2]["printed"] = "4.3";
  EXPECT_EQ(MissingOfTables(other, layout, drawn).size(), 1u);
}

// "4.2E-9" as the printed "4.2".
std::string Digits(const std::string& number) { return number.substr(0, number.find('E')); }

// The numbers that a table of results.json prints, by the name of their column or row.
std::multimap<std::string, std::string> PrintedNumbers(const Json& results) {
  std::multimap<std::string, std::string> numbers;
  const auto add = [&](const std::string& name, std::string text) {
    if (text.starts_with('(')) text = text.substr(1, text.size() - 2);
    const std::size_t between = text.find(" ± ");
    numbers.emplace(name, text.substr(0, between));
    if (between != std::string::npos) numbers.emplace(name, text.substr(between + 4));
  };
  for (const Json& quantity : ListAt(results, "/quantities"))
    for (const char* key : {"printed", "printed_uncertainty"})
      add(Printed(quantity["label"]), TextAt(quantity, std::string("/") + key));
  for (const Json& table : ListAt(results, "/tables"))
    for (const Json& row : ListAt(table, "/rows"))
      for (std::size_t i = 0; i < row.size(); ++i) {
        add(Printed(table["columns"][i]["name"]), Printed(row[i]));
        add(Printed(row[0]), Printed(row[i]));
        // U stands in the column behind its value.
        if (i > 0) add(Printed(table["columns"][i - 1]["name"]), Printed(row[i]));
      }
  return numbers;
}

void ReportReadback::ExpectTheSameNumbers() const {
  const Json results = ReadResults(folder_);
  const auto printed = PrintedNumbers(results);
  const std::string drawn = DrawnText(folder_);
  int count = 0;
  for (const ReadQuantity& quantity : ReadQuantities(FileBytes(folder_ / "dcc.xml"))) {
    // The directions have all digits of calibration.json; they are not printed.
    if (quantity.ref_types.ends_with("_in_array")) continue;
    std::vector<std::string> numbers = quantity.values;
    numbers.insert(numbers.end(), quantity.uncertainties.begin(), quantity.uncertainties.end());
    const auto [first, last] = printed.equal_range(quantity.name);
    for (const std::string& number : numbers) {
      if (number == "NaN") continue;
      const std::string digits = Digits(number);
      EXPECT_TRUE(std::any_of(first, last,
                              [&](const auto& entry) {
                                return Digits(entry.second) == digits ||
                                       entry.second.substr(0, entry.second.find('e')) == digits;
                              }))
          << quantity.name << ": " << number << " is not in results.json";
      EXPECT_NE(drawn.find(digits), std::string::npos) << quantity.name << ": " << number;
      ++count;
    }
  }
  EXPECT_GT(count, 150);  // the tables of any session with a ruler and strain
}

TEST_F(ReportReadback, CertificateResultsAndReportHaveTheSameNumbers) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  WriteFixture();
  MakeReport(folder_, {"acceptance", "en"});
  ExpectTheSameNumbers();
}

TEST_F(ReportReadback, CertificateResultsAndReportOfARealRunHaveTheSameNumbers) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  RunSmallSession();
  MakeReport(folder_, {"acceptance", "en"});
  ExpectTheSameNumbers();
}

}  // namespace
}  // namespace telestrain
