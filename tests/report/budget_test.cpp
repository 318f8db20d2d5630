#include <cmath>

#include "results_of_folder.h"

namespace telestrain {
namespace {

// Of the fixture: √(0.743² + 0.214² + 0.25²) = 0.81262 µm, times k = 2.
TEST(Budget, TheTotalIsTheRootSumOfSquares) {
  const Json results = MakeAndRead(PlausibleResults());
  const Json& table = TableIn(results, "ruler-budget");
  const Json& rows = ListAt(table, "/rows");
  ASSERT_EQ(rows.size(), 5u);
  double squares = 0, shares = 0;
  for (int i = 0; i < 3; ++i) {
    squares += std::pow(*NumberAt(rows[i], "/1/value"), 2);
    shares += *NumberAt(rows[i], "/2/value");
  }
  const Json combined = RowOf(table, "Combined standard uncertainty");
  const Json expanded = RowOf(table, "Expanded uncertainty U (k = 2)");
  EXPECT_NEAR(*NumberAt(combined, "/1/value"), std::sqrt(squares), 1e-12);
  EXPECT_NEAR(*NumberAt(combined, "/1/value"), 0.81262, 1e-5);
  EXPECT_NEAR(*NumberAt(expanded, "/1/value"), 2 * std::sqrt(squares), 1e-12);
  EXPECT_EQ(TextAt(combined, "/1"), "0.81");
  EXPECT_EQ(TextAt(expanded, "/1"), "1.6");
  EXPECT_NEAR(shares, 100, 1e-9);
  EXPECT_EQ(TextAt(rows[0], "/2"), "83.6");  // 0.743² / 0.66035
}

// √(0.0013 - 0.0004) = 0.03; 4 / 13 of the variance is the noise's.
TEST(Budget, TheMagnificationHasOneOfNoiseAndCertificate) {
  ResultsFixture fixture = PlausibleResults();
  fixture.calibration["covariance"] = {{"parameters", {"magnification_px_per_mm"}},
                                       {"matrix", {{0.0013}}},
                                       {"matrix_of_noise", {{0.0004}}}};
  const Json results = MakeAndRead(fixture);
  const Json& table = TableIn(results, "magnification-budget");
  EXPECT_NEAR(*NumberAt(RowOf(table, "cross positions"), "/1/value"), 0.02, 1e-12);
  EXPECT_NEAR(*NumberAt(RowOf(table, "target certificate"), "/1/value"), 0.03, 1e-12);
  EXPECT_EQ(TextAt(RowOf(table, "cross positions"), "/2"), "30.8");
  EXPECT_EQ(TextAt(TableIn(results, "budget"), "/rows/0/0"), "Magnification");
}

TEST(Budget, SourcesSayHowTheyWereEvaluated) {
  ResultsFixture fixture = PlausibleResults();
  fixture.ruler["budget"][0]["source"] = "cross positions";
  fixture.ruler["budget"][1]["source"] = "of unknown kind";
  const Json results = MakeAndRead(fixture);
  const Json& rows = ListAt(TableIn(results, "ruler-budget"), "/rows");
  EXPECT_EQ(rows[0][3], "A");
  EXPECT_EQ(rows[1][3], "–");
  EXPECT_EQ(rows[2][3], "B");  // ruler certificate
}

TEST(Budget, AllMeasurandsStandTogether) {
  const Json results = MakeAndRead(PlausibleResults());
  const Json& rows = ListAt(TableIn(results, "budget"), "/rows");
  ASSERT_EQ(rows.size(), 9u);  // 3 + 2 and 2 + 2
  EXPECT_EQ(TextAt(rows[0], "/0"), "Length of the ruler");
  EXPECT_EQ(TextAt(rows[8], "/0"), "Axial strain");
  EXPECT_EQ(TextAt(rows[8], "/3"), "µε");
}

TEST(Budget, NoComponentsGiveNoTable) {
  ResultsFixture fixture = PlausibleResults();
  fixture.ruler.erase("budget");
  for (Json& line : fixture.strain["budget"]) line["standard_uncertainty_microstrain"] = nullptr;
  const Json results = MakeAndRead(fixture);
  EXPECT_TRUE(TableIn(results, "budget").is_null());
  EXPECT_TRUE(TableIn(results, "ruler-budget").is_null());
}

TEST(Correlation, WhatNobodyMeasuredSaysSo) {
  ResultsFixture fixture = PlausibleResults();
  Json results = MakeAndRead(fixture);
  const Json& idics = TableIn(results, "idics");
  EXPECT_EQ(TextAt(RowOf(idics, "Pattern, size of a feature"), "/1"), "not measured");
  EXPECT_EQ(TextAt(RowOf(idics, "Subset"), "/1"), "31");
  EXPECT_EQ(TextAt(RowOf(idics, "Depth of field, nominal"), "/1"), "3.1");
  EXPECT_EQ(
      TextAt(RowOf(idics, "Strain noise floor, standard deviation between moved states"), "/1"),
      "0.27");
  const Json& floor = TableIn(results, "noise-floor");
  EXPECT_EQ(TextAt(RowOf(floor, "at rest: noise floor"), "/1"), "not measured");
  EXPECT_EQ(TextAt(RowOf(floor, "rigidly moved: pseudo-strain"), "/1"), "3");
  EXPECT_EQ(TextAt(RowOf(floor, "rigidly moved: pseudo-strain"), "/2"), "0.12");
  fixture.strain.erase("sequence");
  results = MakeAndRead(fixture, {}, "without");
  EXPECT_EQ(
      TextAt(RowOf(TableIn(results, "idics"), "Strain noise floor, standard deviation at rest"),
             "/1"),
      "not measured");
}

}  // namespace
}  // namespace telestrain
