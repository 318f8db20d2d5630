#include "results_of_folder.h"

namespace telestrain {
namespace {

TEST(ReportScope, OnlyItsSectionsAreDecidedAndCount) {
  ResultsFixture fixture = PlausibleResults();
  fixture.ruler["images"][2]["error_um"] = 30;  // beyond the limit of 10
  Outcome outcome;
  Json results = MakeAndRead(fixture, {}, "all", &outcome);
  EXPECT_EQ(outcome.verdict, "fail");
  results = MakeAndRead(fixture, {"calibration", {"calibration", "diagnosis"}, {}, {}},
                        "calibration", &outcome);
  EXPECT_EQ(outcome.verdict, "pass");
  EXPECT_TRUE(outcome.accepted);
  EXPECT_EQ(TextAt(results, "/report/layout"), "calibration");
  EXPECT_EQ(ListAt(results, "/report/sections").size(), 2u);
  for (const char* section : {"ruler", "strain", "gauges", "sequence"})
    EXPECT_EQ(EntryAt(results, std::string("/measured/") + section), false) << section;
  for (const char* section : {"calibration", "diagnosis", "pinhole"})
    EXPECT_EQ(EntryAt(results, std::string("/measured/") + section), true) << section;
  EXPECT_TRUE(QuantityIn(results, "ruler_error").is_null());
  EXPECT_TRUE(TableIn(results, "ruler").is_null());
  EXPECT_TRUE(TableIn(results, "strain-states").is_null());
  EXPECT_EQ(TextAt(results, "/decision/printed_undecided"), "");
}

// A report on what was not measured accepts nothing, although other sections were measured.
TEST(ReportScope, AnotherSectionsMeasurementAcceptsNothing) {
  ResultsFixture fixture = PlausibleResults();
  fixture.strain = nullptr;
  fixture.inputs["acceptance"].erase("strain_error_microstrain");
  Outcome outcome;
  MakeAndRead(fixture, {"strain", {"strain"}, {}, {}}, "now", &outcome);
  EXPECT_EQ(outcome.verdict, "undecided");
  EXPECT_FALSE(outcome.accepted);
}

TEST(ReportScope, LimitsOfTheLayoutReplaceTheSessions) {
  const ResultsFixture fixture = PlausibleResults();
  Outcome outcome;
  Json results = MakeAndRead(fixture, {}, "session", &outcome);
  EXPECT_EQ(outcome.verdict, "pass");
  EXPECT_EQ(TextAt(results, "/sentences/limits"), "");
  // The RMS strain error is 4.31 with U = 9.04: beyond 5 it is not proved to be within.
  ReportScope scope;
  scope.name = "strict";
  scope.limits = {{"strain_error_microstrain", 5.0}};
  results = MakeAndRead(fixture, scope, "strict", &outcome);
  EXPECT_EQ(outcome.verdict, "doubt");
  EXPECT_EQ(*NumberAt(QuantityIn(results, "strain_error"), "/limit"), 5);
  EXPECT_EQ(*NumberAt(QuantityIn(results, "ruler_error"), "/limit"), 10);
  EXPECT_EQ(TextAt(results, "/sentences/limits"),
            "Limits of the layout strict are used instead of the session's. Strain error against "
            "the gauges, RMS: 5 µε (session: 20).");
}

TEST(ReportScope, UnknownWordsAreNamed) {
  const auto folder = FolderOfTest("now");
  WriteResults(PlausibleResults(), folder);
  const auto expect = [&](const ReportScope& scope, const std::string& words) {
    const auto made = MakeResults(folder, scope);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().kind, ErrorKind::kBadInput);
    EXPECT_NE(made.error().message.find(words), std::string::npos) << made.error().message;
  };
  expect({"mine", {"rulers"}, {}, {}}, "layout 'mine': section 'rulers' does not exist; use");
  expect({"mine", {}, {{"ruler_mpe_mm", 1.0}}, {}}, "limit 'ruler_mpe_mm' does not exist; use");
  expect({"mine", {}, {{"ruler_mpe_um", 0.0}}, {}}, "is larger than 0");
}

TEST(ReportScope, SummaryRowsLeadToTheirSections) {
  const Json results = MakeAndRead(PlausibleResults());
  const Json& summary = TableIn(results, "summary");
  const Json& links = ListAt(summary, "/row_links");
  ASSERT_EQ(links.size(), ListAt(summary, "/rows").size());
  EXPECT_EQ(links.front(), "calibration");
  EXPECT_EQ(links.back(), "strain");
  EXPECT_NE(std::find(links.begin(), links.end(), Json("diagnosis")), links.end());
  EXPECT_NE(std::find(links.begin(), links.end(), Json("ruler")), links.end());
}

}  // namespace
}  // namespace telestrain
