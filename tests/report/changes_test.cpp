#include <cmath>
#include <fstream>

#include "base/files.h"
#include "results_of_folder.h"

namespace telestrain {
namespace {

// The fixture as it was measured earlier.
ResultsFixture Earlier() {
  ResultsFixture fixture = PlausibleResults();
  fixture.inputs["document"]["number"] = "AR-2025-0007";
  fixture.inputs["document"]["date"] = "2025-02-03";
  fixture.calibration["lens"]["magnification_px_per_mm"] = 227.2571436;
  fixture.strain["comparison"]["rms_error_microstrain"] = 5.31;
  return fixture;
}

class Changes : public ::testing::Test {
 protected:
  Json Compare(const ResultsFixture& earlier, const ResultsFixture& now) {
    MakeAndRead(earlier, {}, "earlier");
    ReportScope scope;
    scope.earlier = FolderOfTest("earlier");
    return MakeAndRead(now, scope);
  }
  void ExpectRefused(const std::filesystem::path& earlier, const std::string& words) {
    const auto folder = FolderOfTest("refused");
    WriteResults(PlausibleResults(), folder);
    ReportScope scope;
    scope.earlier = earlier;
    const auto made = MakeResults(folder, scope);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().kind, ErrorKind::kBadInput);
    EXPECT_NE(made.error().message.find(words), std::string::npos) << made.error().message;
  }
};

// Computed by hand: 4.31 - 5.31 = -1; U = 2 · 4.52 = 9.04 in both, so U of the change is
// 9.04 · √2 = 12.7845 and En = 1 / 12.7845 = 0.0782. The magnification: 227.2871436 - 227.2571436 =
// 0.03; U = 2 · 0.00612 = 0.01224 in both, of the change 0.0173100, En = 1.7331.
TEST_F(Changes, EveryQuantityIsComparedByItsEn) {
  const Json results = Compare(Earlier(), PlausibleResults());
  const Json& table = TableIn(results, "changes");
  const Json strain = RowOf(table, "Strain error against the gauges, RMS");
  EXPECT_NEAR(*NumberAt(strain, "/5/value"), -1, 1e-12);
  EXPECT_NEAR(*NumberAt(strain, "/6/value"), 12.7845, 1e-4);
  EXPECT_NEAR(*NumberAt(strain, "/7/value"), 0.0782, 1e-4);
  EXPECT_EQ(TextAt(strain, "/5"), "-1");
  EXPECT_EQ(TextAt(strain, "/6"), "13");
  EXPECT_EQ(TextAt(strain, "/9"), "within U");
  const Json magnification = RowOf(table, "Magnification");
  EXPECT_EQ(TextAt(magnification, "/1"), "227.257");
  EXPECT_NEAR(*NumberAt(magnification, "/5/value"), 0.03, 1e-9);
  EXPECT_NEAR(*NumberAt(magnification, "/6/value"), 0.01731, 1e-6);
  EXPECT_NEAR(*NumberAt(magnification, "/7/value"), 1.7331, 1e-4);
  EXPECT_EQ(TextAt(magnification, "/9"), "changed by more than U");
  // One that has no uncertainty changed, but is not judged.
  const Json reprojection = RowOf(table, "Reprojection error, RMS");
  EXPECT_EQ(*NumberAt(reprojection, "/5/value"), 0);
  EXPECT_TRUE(EntryAt(reprojection, "/7/value").is_null());
  EXPECT_EQ(TextAt(reprojection, "/9"), "no uncertainty to judge it by");
  EXPECT_NE(TextAt(results, "/sentences/changes").find(" 1 changed by more than U: Magnification."),
            std::string::npos)
      << TextAt(results, "/sentences/changes");
  EXPECT_EQ(EntryAt(results, "/measured/changes"), true);
}

TEST_F(Changes, TheEarlierReportIsNamed) {
  const Json results = Compare(Earlier(), PlausibleResults());
  const Json& table = TableIn(results, "earlier");
  EXPECT_EQ(TextAt(RowOf(table, "Report number"), "/1"), "AR-2025-0007");
  EXPECT_EQ(TextAt(RowOf(table, "Date"), "/1"), "2025-02-03");
  EXPECT_EQ(TextAt(RowOf(table, "SHA-256"), "/1"),
            *Sha256HexOfFile(FolderOfTest("earlier") / "results.json"));
}

// With k = 3 now and 2 then, the earlier U is widened to k = 3: U of the strain error is 13.56 in
// both, so of the change 19.1767.
TEST_F(Changes, AnotherCoverageFactorIsConverted) {
  ResultsFixture now = PlausibleResults();
  now.inputs["acceptance"]["coverage_factor"] = 3.0;
  const Json results = Compare(Earlier(), now);
  const Json strain = RowOf(TableIn(results, "changes"), "Strain error against the gauges, RMS");
  EXPECT_NEAR(*NumberAt(strain, "/6/value"), 19.1767, 1e-4);
}

Json Comparison(const std::string& sha256) {
  Json json{{"schema", "telestrain.comparison/1"},
            {"compared_with", {{"file", "earlier/calibration.json"}, {"sha256", sha256}}},
            {"changes", Json::array()}};
  json["changes"].push_back({{"quantity", "shift of the field of A1 along u"},
                             {"unit", "um"},
                             {"value", 0.9},
                             {"standard_uncertainty", 0.25},
                             {"significant", true}});
  return json;
}

TEST_F(Changes, ComparisonOfTheCalibrationsIsUsedWhenItIsOfThisEarlierOne) {
  MakeAndRead(Earlier(), {}, "earlier");
  ReportScope scope;
  scope.earlier = FolderOfTest("earlier");
  const auto folder = FolderOfTest("now");
  WriteResults(PlausibleResults(), folder);
  const auto table_with = [&](const std::string& sha256) -> Json {
    std::ofstream(folder / "comparison.json") << Comparison(sha256);
    EXPECT_TRUE(MakeResults(folder, scope));
    return TableIn(*ReadJson(folder / "results.json", "telestrain.results/1", "test"),
                   "changes-calibration");
  };
  const Json row = RowOf(table_with(*Sha256HexOfFile(scope.earlier / "calibration.json")),
                         "shift of the field of A1 along u");
  EXPECT_EQ(TextAt(row, "/4"), "µm") << row.dump();
  EXPECT_NEAR(*NumberAt(row, "/3/value"), 1.8, 1e-12);  // 0.9 / (2 · 0.25)
  EXPECT_EQ(TextAt(row, "/5"), "changed by more than U");
  // Of another one: compared here.
  const Json other = table_with(std::string(64, 'f'));
  EXPECT_EQ(ListAt(other, "/rows").size(), 13u);  // the magnification, and three of each view
  EXPECT_NEAR(*NumberAt(RowOf(other, "magnification"), "/1/value"), 0.03, 1e-9);
}

TEST_F(Changes, TheVerySameMeasurementsAreRefused) {
  MakeAndRead(PlausibleResults(), {}, "same");
  ExpectRefused(FolderOfTest("same"), "the very same measurements");
}

TEST_F(Changes, AnotherInstrumentIsRefused) {
  ResultsFixture other = Earlier();
  for (Json& view : other.calibration["views"])
    if (view["name"] == "A1") view["name"] = "C1";
  MakeAndRead(other, {}, "other");
  ExpectRefused(FolderOfTest("other"), "has the views 'C1, A2, B1, B2', these results have");
}

TEST_F(Changes, AnotherSensorLensOrArtefactIsRefused) {
  const auto expect = [&](const char* pointer, const Json& value, const std::string& words) {
    ResultsFixture now = PlausibleResults(), then = Earlier();
    for (ResultsFixture* fixture : {&now, &then}) {
      fixture->inputs["document"]["target_serial"] = "T-1182";
      fixture->inputs["views"] = {{{"name", "A1"}, {"region_px", {0, 0, 1296, 972}}}};
    }
    then.inputs[Json::json_pointer(pointer)] = value;
    MakeAndRead(then, {}, "other");
    const auto folder = FolderOfTest("refused");
    WriteResults(now, folder);
    ReportScope scope;
    scope.earlier = FolderOfTest("other");
    const auto made = MakeResults(folder, scope);
    ASSERT_FALSE(made) << pointer;
    EXPECT_EQ(made.error().kind, ErrorKind::kBadInput);
    EXPECT_NE(made.error().message.find(words), std::string::npos) << made.error().message;
  };
  expect("/sensor/width_px", 648, "the sensor width in px 648, these results have 2592; compare");
  expect("/lens/magnification", 0.125, "the nominal magnification 0.125, these results have 0.5");
  expect("/views/0/region_px", Json{0, 0, 324, 243},
         "for view A1 the region_px [0,0,324,243], these results have [0,0,1296,972]");
  expect("/document/target_serial", "T-7", "target_serial T-7, these results have T-1182");
}

// 1 of the 4.31/5.31 µε kind is within, the magnification is not: see the first test.
TEST_F(Changes, TheFirstPageSaysHowManyValuesChanged) {
  const Json results = Compare(Earlier(), PlausibleResults());
  const std::string words = TextAt(results, "/sentences/compared_with");
  EXPECT_EQ(words.find("Compared with AR-2025-0007 of 2025-02-03: 1 of "), 0u) << words;
  EXPECT_NE(words.find("In the instrument 1 of 1 values moved"), std::string::npos) << words;
}

TEST_F(Changes, AnEnFarBeyondOneIsNotPrintedInFull) {
  ResultsFixture earlier = Earlier();
  earlier.calibration["lens"]["magnification_px_per_mm"] = 57.0;
  const Json row = RowOf(TableIn(Compare(earlier, PlausibleResults()), "changes"), "Magnification");
  EXPECT_GT(*NumberAt(row, "/7/value"), 100);
  EXPECT_EQ(TextAt(row, "/7"), "> 100");
}

TEST_F(Changes, WhatIsNoReportIsRefused) {
  const auto empty = FolderOfTest("empty");
  std::filesystem::create_directories(empty);
  ExpectRefused(empty, "has no results.json; name the results folder");
  ExpectRefused(empty / "nothing.pdf", "does not exist");
  std::ofstream(empty / "text.pdf") << "no PDF";
  ExpectRefused(empty / "text.pdf", "text.pdf");
}

}  // namespace
}  // namespace telestrain
