#include "results_of_folder.h"

namespace telestrain {
namespace {

TEST(Item, EveryKeyOfTheDocumentIsPrinted) {
  ResultsFixture fixture = PlausibleResults();
  Json& document = fixture.inputs["document"];
  document["condition"] = "as received, without marks";
  document["target_serial"] = "T-1";
  document["shift_of_day"] = "night";  // a word of the customer's own
  const Json results = MakeAndRead(fixture);
  const Json& table = TableIn(results, "item");
  for (const auto& [key, value] : document.items()) {
    if (key == "revision") continue;  // in the title band
    int found = 0;
    for (const Json& row : ListAt(table, "/rows")) found += row[1] == value;
    EXPECT_EQ(found, 1) << key;
  }
  EXPECT_EQ(TextAt(RowOf(table, "Condition of the item"), "/1"), "as received, without marks");
  EXPECT_EQ(TextAt(RowOf(table, "Shift of day"), "/1"), "night");
  EXPECT_EQ(TextAt(ListAt(table, "/rows").back(), "/0"), "Shift of day");
}

// The laboratory, the procedure and the rest are left to the second section.
TEST(Item, TheFirstPageHoldsSixFactsInFixedOrder) {
  ResultsFixture fixture = PlausibleResults();
  Json& document = fixture.inputs["document"];
  document["serial_numbers"] = "P-7731";
  document["place"] = "room 4";
  document["measured"] = "2026-01-30";  // before the date of issue, 2026-01-31
  std::vector<std::string> labels;
  const Json results = MakeAndRead(fixture);
  for (const Json& row : ListAt(TableIn(results, "document"), "/rows"))
    labels.push_back(TextAt(row, "/0"));
  EXPECT_EQ(labels,
            (std::vector<std::string>{"Customer", "Item", "Serial numbers", "Date of the test",
                                      "Place of the test", "Operator"}));
}

TEST(Item, WhatACompleteCertificateWantsIsNamed) {
  ResultsFixture fixture = PlausibleResults();
  EXPECT_EQ(TextAt(MakeAndRead(fixture), "/sentences/not_stated"),
            "Not stated in the session: Serial numbers; Condition of the item; Place of the test; "
            "Date of the test; Authorised by.");
  Json& document = fixture.inputs["document"];
  document["item_serial"] = "P-7731";
  document["condition"] = "as received";
  document["place"] = "room 4";
  document["measured"] = "2026-01-30";
  document["approver"] = "Ada";
  const Json results = MakeAndRead(fixture, {}, "complete");
  EXPECT_EQ(TextAt(results, "/sentences/not_stated"), "");
  EXPECT_EQ(TextAt(RowOf(TableIn(results, "statements"), "Authorised by"), "/1"), "Ada");
}

TEST(Item, StatementsHoldTheScopeAndTheUncertainty) {
  const Json results = MakeAndRead(PlausibleResults());
  const Json& table = TableIn(results, "statements");
  EXPECT_EQ(TextAt(RowOf(table, "Scope"), "/1"), "The results relate only to the items tested.");
  EXPECT_EQ(ListAt(table, "/rows").size(), 4u);  // the rule is a sentence of the summary
  EXPECT_NE(TextAt(RowOf(table, "Uncertainty"), "/1").find("k = 2, for a normal distribution"),
            std::string::npos);
  EXPECT_EQ(TextAt(RowOf(table, "Authorised by"), "/1"), "not stated in the session");
}

TEST(Item, ADocumentOfAnotherKindIsNone) {
  ResultsFixture fixture = PlausibleResults();
  fixture.inputs["document"] = 7;
  const Json results = MakeAndRead(fixture);
  EXPECT_TRUE(TableIn(results, "item").is_null());
  EXPECT_NE(TextAt(results, "/sentences/not_stated").find("Laboratory; Customer; Item"),
            std::string::npos);
}

}  // namespace
}  // namespace telestrain
