#pragma once

#include <gtest/gtest.h>

#include "base/json_file.h"
#include "report/acceptance_report.h"
#include "report/json_lookup.h"
#include "results_fixture.h"

namespace telestrain {

// A folder of its own for the running test.
inline std::filesystem::path FolderOfTest(const std::string& name) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  return std::filesystem::path(::testing::TempDir()) /
         ("telestrain_content_" + std::string(test->name()) + "_" + name);
}

// Writes the fixture into that folder, makes results.json and reads it back.
inline Json MakeAndRead(ResultsFixture fixture, const ReportScope& scope = {},
                        const std::string& name = "now", Outcome* outcome = nullptr) {
  fixture.pictures = false;
  const auto folder = FolderOfTest(name);
  WriteResults(fixture, folder);
  const auto made = MakeResults(folder, scope);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  if (made && outcome != nullptr) *outcome = *made;
  auto json = ReadJson(folder / "results.json", "telestrain.results/1", "test");
  EXPECT_TRUE(json);
  return json ? *json : Json();
}

inline const Json& TableIn(const Json& results, const std::string& id) {
  return FindBy(ListAt(results, "/tables"), "id", id);
}

inline const Json& QuantityIn(const Json& results, const std::string& id) {
  return FindBy(ListAt(results, "/quantities"), "id", id);
}

// The row of a table whose first cell prints `name`; null without one.
inline Json RowOf(const Json& table, const std::string& name) {
  for (const Json& row : ListAt(table, "/rows"))
    if (TextAt(row, "/0") == name) return row;
  return nullptr;
}

}  // namespace telestrain
