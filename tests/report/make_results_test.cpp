#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/json_file.h"
#include "base/numbers.h"
#include "pdf_tools.h"
#include "report/acceptance_report.h"
#include "report/json_lookup.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

// Writes the fixture, makes results.json and reads it back; `outcome` is what MakeResults returned.
Json ResultsOf(const ResultsFixture& fixture, Outcome& outcome) {
  const auto folder = TestFolder("make_results");
  WriteResults(fixture, folder);
  const auto made = MakeResults(folder);
  EXPECT_TRUE(made) << made.error().message;
  outcome = made ? *made : Outcome{};
  auto json = ReadJson(folder / "results.json", "telestrain.results/1", "test");
  EXPECT_TRUE(json);
  return json ? *json : Json();
}

Json ResultsOf(const ResultsFixture& fixture, std::string& verdict) {
  Outcome outcome;
  Json json = ResultsOf(fixture, outcome);
  verdict = outcome.verdict;
  return json;
}

ResultsFixture WithoutPictures() {
  ResultsFixture fixture = PlausibleResults();
  fixture.pictures = false;
  return fixture;
}

const Json& QuantityOf(const Json& results, const std::string& id) {
  return FindBy(ListAt(results, "/quantities"), "id", id);
}

TEST(MakeResults, DecidesWhatHasALimit) {
  std::string verdict;
  const Json results = ResultsOf(WithoutPictures(), verdict);
  EXPECT_EQ(verdict, "pass");
  EXPECT_EQ(TextAt(results, "/verdict"), "pass");
  for (const char* id : {"reprojection_rms", "ruler_error", "strain_error"})
    EXPECT_EQ(TextAt(QuantityOf(results, id), "/verdict"), "pass") << id;
  EXPECT_EQ(TextAt(QuantityOf(results, "reprojection_rms"), "/printed"), "0.0437");
  EXPECT_EQ(TextAt(QuantityOf(results, "reprojection_rms"), "/printed_limit"), "≤ 1");
}

TEST(MakeResults, TheWorstRulerImageStandsInTheSummary) {
  ResultsFixture fixture = WithoutPictures();
  fixture.ruler["images"][4]["error_um"] = -9.2;  // U = 2 · 0.89: in doubt against 10
  std::string verdict;
  Json results = ResultsOf(fixture, verdict);
  EXPECT_EQ(verdict, "doubt");
  EXPECT_DOUBLE_EQ(*NumberAt(QuantityOf(results, "ruler_error"), "/value"), -9.2);
  // A small error with a proof of failure outranks a larger one in doubt.
  fixture.ruler["images"][2]["error_um"] = 10.5;
  fixture.ruler["images"][2]["standard_uncertainty_um"] = 0.1;
  results = ResultsOf(fixture, verdict);
  EXPECT_EQ(verdict, "fail");
  EXPECT_DOUBLE_EQ(*NumberAt(QuantityOf(results, "ruler_error"), "/value"), 10.5);
  EXPECT_EQ(TextAt(QuantityOf(results, "ruler_error"), "/printed_uncertainty"), "0.20");
}

TEST(MakeResults, TheSimpleRuleIgnoresTheUncertainty) {
  ResultsFixture fixture = WithoutPictures();
  fixture.ruler["images"][4]["error_um"] = -9.2;
  fixture.inputs["acceptance"]["decision_rule"] = "simple";
  std::string verdict;
  ResultsOf(fixture, verdict);
  EXPECT_EQ(verdict, "pass");
}

TEST(MakeResults, MissingPartsAreNotMeasured) {
  ResultsFixture fixture = WithoutPictures();
  fixture.ruler = fixture.strain = fixture.calibration = fixture.detection = nullptr;
  std::string verdict;
  const Json results = ResultsOf(fixture, verdict);
  EXPECT_EQ(verdict, "undecided");
  for (const char* section : {"calibration", "ruler", "strain", "gauges"})
    EXPECT_EQ(EntryAt(results, std::string("/measured/") + section), false) << section;
  EXPECT_NE(TextAt(results, "/decision/printed_undecided").find("Length error"), std::string::npos);
}

TEST(MakeResults, LimitsThatAreAbsentAreNotDecided) {
  ResultsFixture fixture = WithoutPictures();
  fixture.inputs["acceptance"].erase("ruler_mpe_um");
  std::string verdict;
  Json results = ResultsOf(fixture, verdict);
  EXPECT_EQ(verdict, "pass");
  EXPECT_TRUE(EntryAt(QuantityOf(results, "ruler_error"), "/verdict").is_null());
  // A limit that is there but cannot be decided must not hide behind the others.
  fixture.strain["comparison"] = nullptr;
  results = ResultsOf(fixture, verdict);
  EXPECT_EQ(verdict, "undecided");
  EXPECT_TRUE(EntryAt(QuantityOf(results, "strain_error"), "/value").is_null());
}

const Json& TableOf(const Json& results, const std::string& id) {
  return FindBy(ListAt(results, "/tables"), "id", id);
}

TEST(MakeResults, WhatLacksItsUncertaintyIsNotDecided) {
  for (const char* rule : {"guarded", "simple"}) {
    ResultsFixture fixture = WithoutPictures();
    fixture.inputs["acceptance"]["decision_rule"] = rule;
    fixture.ruler["images"][4]["standard_uncertainty_um"] = nullptr;  // as a NaN is written
    Outcome outcome;
    Json results = ResultsOf(fixture, outcome);
    EXPECT_EQ(outcome.verdict, "undecided");
    EXPECT_FALSE(outcome.accepted);
    EXPECT_TRUE(EntryAt(QuantityOf(results, "ruler_error"), "/verdict").is_null());
    // The image that is not known stands in the summary, not one that passed.
    EXPECT_EQ(QuantityOf(results, "ruler_error")["value"], fixture.ruler["images"][4]["error_um"]);
    EXPECT_NE(TextAt(results, "/decision/printed_undecided").find("Length error"),
              std::string::npos);
    fixture = WithoutPictures();
    fixture.inputs["acceptance"]["decision_rule"] = rule;
    fixture.strain["comparison"].erase("standard_uncertainty_microstrain");
    results = ResultsOf(fixture, outcome);
    EXPECT_EQ(outcome.verdict, "undecided");
    EXPECT_FALSE(outcome.accepted);
    EXPECT_TRUE(EntryAt(QuantityOf(results, "strain_error"), "/verdict").is_null());
  }
}

TEST(MakeResults, AProofOfFailureOutranksAMissingUncertainty) {
  ResultsFixture fixture = WithoutPictures();
  fixture.ruler["images"][4]["standard_uncertainty_um"] = nullptr;
  fixture.ruler["images"][2]["error_um"] = 30;
  std::string verdict;
  const Json results = ResultsOf(fixture, verdict);
  EXPECT_EQ(verdict, "fail");
  EXPECT_DOUBLE_EQ(*NumberAt(QuantityOf(results, "ruler_error"), "/value"), 30);
}

TEST(MakeResults, TheStrainErrorIsDecidedWithTheCamerasUncertainty) {
  ResultsFixture fixture = WithoutPictures();
  std::string verdict;
  Json results = ResultsOf(fixture, verdict);
  EXPECT_DOUBLE_EQ(*NumberAt(QuantityOf(results, "strain_error"), "/expanded_uncertainty"), 9.04);
  EXPECT_EQ(TextAt(QuantityOf(results, "strain_error"), "/verdict"), "pass");
  fixture.strain["comparison"]["rms_error_microstrain"] = 12.0;  // 12 + 9.04 > 20
  results = ResultsOf(fixture, verdict);
  EXPECT_EQ(TextAt(QuantityOf(results, "strain_error"), "/verdict"), "doubt");
}

TEST(MakeResults, TheGaugesUncertaintyCountsWhereItIsKnown) {
  ResultsFixture fixture = WithoutPictures();
  fixture.strain["comparison"]["error_uncertainty_microstrain"] = 5.0;
  std::string verdict;
  const Json results = ResultsOf(fixture, verdict);
  EXPECT_DOUBLE_EQ(*NumberAt(QuantityOf(results, "strain_error"), "/expanded_uncertainty"), 10);
  EXPECT_NE(TextAt(results, "/sentences/strain_uncertainty").find("and the gauges'"),
            std::string::npos);
}

TEST(MakeResults, DecisionsSayTheirMarginInWords) {
  ResultsFixture fixture = WithoutPictures();
  fixture.ruler["images"][4]["error_um"] = -9.2;  // U = 2 · 0.89
  std::string verdict;
  const Json results = ResultsOf(fixture, verdict);
  const Json& rows = TableOf(results, "decisions")["rows"];
  ASSERT_EQ(rows.size(), 3u);
  bool found = false;
  for (const Json& row : rows)
    found = found || TextAt(row, "/1") ==
                         "in doubt: 0.8 µm inside the limit, less than U; a repeat with U of 0.8 "
                         "µm or less passes";
  EXPECT_TRUE(found) << rows.dump(1);
}

TEST(MakeResults, OlderResultsWithoutAcceptanceAndSequenceAreRead) {
  ResultsFixture fixture = WithoutPictures();
  fixture.ruler.erase("acceptance");
  fixture.strain.erase("sequence");
  std::string verdict;
  const Json results = ResultsOf(fixture, verdict);
  EXPECT_EQ(verdict, "pass");
  EXPECT_EQ(EntryAt(results, "/measured/sequence"), false);
  EXPECT_TRUE(EntryAt(TableOf(results, "ruler")["rows"][0], "/5/value").is_null());
}

TEST(MakeResults, TheGaugesChangeIsComparedNotTheirReading) {
  const ResultsFixture fixture = WithoutPictures();
  std::string verdict;
  const Json results = ResultsOf(fixture, verdict);
  const Json& table = TableOf(results, "strain-states");
  EXPECT_EQ(TextAt(table, "/columns/9/name"), "Gauges, change");
  const Json& states = ListAt(fixture.strain, "/states");
  ASSERT_EQ(ListAt(table, "/rows").size(), states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double change = states[i]["gauge_change_microstrain"];
    const double axial = states[i]["axial_microstrain"];
    EXPECT_DOUBLE_EQ(*NumberAt(table["rows"][i], "/9/value"), change);
    EXPECT_DOUBLE_EQ(*NumberAt(table["rows"][i], "/10/value"), axial - change);
  }
}

// What was measured while watching a folder is named with its own hash, not the session's.
TEST(MakeResults, WatchedImagesStandWithTheirOwnHash) {
  ResultsFixture fixture = WithoutPictures();
  const std::string image = fixture.strain["states"][1]["image"];
  fixture.strain["states"][1]["image_sha256"] = std::string(64, 'e');
  std::string verdict;
  const Json results = ResultsOf(fixture, verdict);
  int rows = 0;
  for (const Json& row : ListAt(TableOf(results, "input-files"), "/rows")) {
    const std::string name = TextAt(row, "/0");
    if (name.find(image) == std::string::npos) continue;
    ++rows;
    EXPECT_EQ(name, image + " (watched)");
    EXPECT_EQ(row[2], std::string(64, 'e'));
  }
  EXPECT_EQ(rows, 1);
}

TEST(MakeResults, AGaugeWithUnknownChangeIsLeftOut) {
  ResultsFixture fixture = WithoutPictures();
  fixture.strain["states"][2]["gauge_change_microstrain"] = nullptr;
  std::string verdict;
  const Json results = ResultsOf(fixture, verdict);
  const Json& row = TableOf(results, "strain-states")["rows"][2];
  EXPECT_TRUE(EntryAt(row, "/9/value").is_null());
  EXPECT_TRUE(EntryAt(row, "/10/value").is_null());
}

TEST(MakeResults, NothingMeasuredIsNotAccepted) {
  ResultsFixture fixture = WithoutPictures();
  fixture.inputs["acceptance"] = {{"coverage_factor", 2.0}, {"decision_rule", "guarded"}};
  Outcome outcome;
  ResultsOf(fixture, outcome);
  EXPECT_EQ(outcome.verdict, "undecided");
  EXPECT_TRUE(outcome.accepted);  // measured, and no limit was set
  fixture.ruler = fixture.strain = fixture.calibration = fixture.detection = nullptr;
  ResultsOf(fixture, outcome);
  EXPECT_EQ(outcome.verdict, "undecided");
  EXPECT_FALSE(outcome.accepted);
}

TEST(MakeResults, TheLabelsSayWhatTheirUncertaintyHolds) {
  std::string verdict;
  const Json results = ResultsOf(WithoutPictures(), verdict);
  EXPECT_EQ(TextAt(TableOf(results, "lens"), "/rows/0/0"),
            "Magnification (U with the certificate of the pitch)");
  EXPECT_EQ(TextAt(TableOf(results, "pipe"), "/rows/0/0"), "Outer diameter (U of the fit)");
}

// Half a unit of the last printed place.
double HalfPlace(const std::string& printed) {
  const std::size_t exponent = printed.find('e');
  const std::string mantissa = printed.substr(0, exponent);
  const std::size_t point = mantissa.find('.');
  const auto decimals = point == std::string::npos ? 0 : mantissa.size() - point - 1;
  const double power =
      exponent == std::string::npos ? 0 : *ParseDouble(printed.substr(exponent + 1));
  return 0.5001 * std::pow(10.0, power - static_cast<double>(decimals));
}

TEST(MakeResults, EveryPrintedNumberIsItsValueRounded) {
  std::string verdict;
  const Json results = ResultsOf(WithoutPictures(), verdict);
  int compared = 0;
  for (const Json& table : ListAt(results, "/tables"))
    for (const Json& row : ListAt(table, "/rows"))
      for (const Json& cell : row) {
        const auto value = NumberAt(cell, "/value");
        const auto printed = ParseDouble(TextAt(cell, "/printed"));
        if (!value || !printed) continue;
        EXPECT_NEAR(*printed, *value, HalfPlace(TextAt(cell, "/printed"))) << cell.dump();
        ++compared;
      }
  EXPECT_GT(compared, 300);
}

TEST(MakeResults, RejectedImagesAreListedWithTheirReasons) {
  std::string verdict;
  const Json results = ResultsOf(WithoutPictures(), verdict);
  const auto rows = [&](const char* id) { return ListAt(TableOf(results, id), "/rows").size(); };
  EXPECT_EQ(rows("boards-rejected"), 1u);
  EXPECT_EQ(rows("corners-rejected"), 1u);
  EXPECT_EQ(rows("ruler-rejected"), 1u);
  EXPECT_EQ(rows("strain-rejected"), 3u);
  EXPECT_EQ(rows("input-files"), 46u);
}

TEST(MakeResults, PointsLostInTheReferenceImageAreListed) {
  std::string verdict;
  const Json results = ResultsOf(WithoutPictures(), verdict);
  const Json& row = TableOf(results, "strain-rejected")["rows"][0];
  EXPECT_EQ(row[0], "reference image");
  EXPECT_EQ(row[1], "no partner in the second view");
  EXPECT_EQ(TextAt(row, "/2/printed"), "17");
}

TEST(MakeResults, LostCornersAreNotLostBoards) {
  ResultsFixture fixture = WithoutPictures();
  fixture.calibration["rejected"].push_back({{"image", "calibration/target_05.png"},
                                             {"view", "A2"},
                                             {"reason", "the board does not fit the array"},
                                             {"corners", 117},
                                             {"whole_board", true}});
  std::string verdict;
  Json results = ResultsOf(fixture, verdict);
  const Json& boards = TableOf(results, "boards-rejected")["rows"];
  ASSERT_EQ(boards.size(), 2u);  // the detector's once, then the calibration's
  EXPECT_EQ(boards[0][0], "calibration/target_07.png");
  EXPECT_EQ(boards[1][0], "calibration/target_05.png");
  const Json& corners = TableOf(results, "corners-rejected")["rows"];
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_EQ(corners[0][0], "calibration/target_11.png");
  EXPECT_EQ(corners[0][1], "A1");
  EXPECT_EQ(TextAt(corners[0], "/2/printed"), "12");
  // Without the detector's file its rejections are known from the calibration only.
  fixture.detection = nullptr;
  results = ResultsOf(fixture, verdict);
  EXPECT_EQ(TableOf(results, "boards-rejected")["rows"].size(), 2u);
}

TEST(MakeResults, TheSameFolderGivesTheSameBytes) {
  const auto folder = TestFolder("same");
  WriteResults(WithoutPictures(), folder);
  ASSERT_TRUE(MakeResults(folder));
  const std::string first = FileBytes(folder / "results.json");
  ASSERT_TRUE(MakeResults(folder));
  EXPECT_EQ(FileBytes(folder / "results.json"), first);
}

TEST(MakeResults, BadFilesAreBadInput) {
  const auto folder = TestFolder("bad");
  WriteResults(WithoutPictures(), folder);
  std::ofstream(folder / "ruler.json") << "{\"schema\": \"telestrain.ruler/1\"";
  const auto broken = MakeResults(folder);
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().kind, ErrorKind::kBadInput);
  EXPECT_NE(broken.error().message.find("ruler.json"), std::string::npos);
  std::filesystem::remove(folder / "inputs.json");
  const auto missing = MakeResults(folder);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("inputs.json"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "results.json"));
}

// A file of the right schema and the wrong content must not throw.
TEST(MakeResults, WrongTypesAreReadAsMissing) {
  ResultsFixture fixture = WithoutPictures();
  fixture.calibration["lens"] = "none";
  fixture.calibration["views"] = 7;
  fixture.calibration["reprojection"]["rms_px"] = "0.04";
  fixture.ruler["images"] = Json::object();
  fixture.strain["states"][1]["points_rejected"] = "many";
  fixture.inputs["document"] = Json::array();
  std::string verdict;
  const Json results = ResultsOf(fixture, verdict);
  EXPECT_EQ(verdict, "undecided");  // the strain passes, the other limits are not decided
  EXPECT_EQ(EntryAt(results, "/measured/calibration"), false);
}

}  // namespace
}  // namespace telestrain
