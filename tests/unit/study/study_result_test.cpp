#include "study/study_result.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace telestrain {
namespace {

StudyResult Sample() {
  StudyResult result;
  result.study = "sample";
  result.title = "A sample";
  result.comparison = {{"largest error", "µm", "10.02", "1.5", "≤ 2", true, "nothing"},
                       {"mean", "px", "-", "0.1", "-", std::nullopt, ""}};
  result.tables = {
      {"t", "A table", {{"arm", ""}, {"sd", "µm"}}, {{"one", StudyNumber{0.12345, 3}}}}};
  result.plots = {{"p", "A plot", "", {"x", false}, {"y", true}}};
  result.plots[0].series = {{"s", SeriesKind::kMarkers, {1, 2}, {3, 4}}};
  return result;
}

TEST(StudyResult, NumbersOfTablesAreWrittenWholeAndAsPrinted) {
  const auto json = Sample().ToJson();
  EXPECT_EQ(json["schema"], "telestrain.study/1");
  const auto& cell = json["tables"][0]["rows"][0][1];
  EXPECT_EQ(cell["value"], 0.12345);
  EXPECT_EQ(cell["printed"], "0.123");
  EXPECT_EQ(json["plots"][0]["series"][0]["kind"], "markers");
  EXPECT_EQ(json["plots"][0]["y"]["log"], true);
}

TEST(StudyResult, OnlyDecidedLimitsCount) {
  StudyResult result = Sample();
  EXPECT_TRUE(result.AllMet());
  EXPECT_TRUE(result.ToJson()["comparison"][1]["met"].is_null());
  result.comparison[0].met = false;
  EXPECT_FALSE(result.AllMet());
  EXPECT_NE(result.ComparisonText().find("NOT met"), std::string::npos);
}

TEST(StudyResult, TheTextTableIsAlignedInCharactersNotBytes) {
  const std::string text = Sample().ComparisonText();
  const auto column = [&](const std::string& word, const std::string& line_start) {
    const std::size_t line = text.find(line_start);
    std::size_t characters = 0;
    for (std::size_t i = line; i < text.find(word, line); ++i)
      characters += (text[i] & 0xC0) != 0x80;
    return characters;
  };
  EXPECT_EQ(column("10.02", "largest"), column("paper", "quantity"));
  EXPECT_EQ(column("≤ 2", "largest"), column("limit", "quantity"));
}

}  // namespace
}  // namespace telestrain
