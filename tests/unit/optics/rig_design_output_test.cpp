#include "optics/rig_design_output.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/numbers.h"
#include "unit/optics/paper_rig.h"

namespace telestrain {
namespace {

using testing_support::PaperRig;

RigDesign PaperDesign() { return AnalyseRig(PaperRig(), {}).value(); }

TEST(DesignJson, HoldsTheNumbersOfTheDesign) {
  const RigDesign design = PaperDesign();
  const auto json = nlohmann::ordered_json::parse(DesignJson(PaperRig(), design));
  EXPECT_EQ(json.at("schema"), "telestrain.design/1");
  EXPECT_EQ(json.at("array").at("total_field_mm"), design.total_field_mm);
  ASSERT_EQ(json.at("views").size(), 4u);
  const auto& view = json.at("views").at(1);
  EXPECT_EQ(view.at("name"), "A2");
  EXPECT_EQ(view.at("focus_path_mm"), design.views[1].focus_path_mm);
  EXPECT_EQ(view.at("mirrors").at(2).at("name"), "A2 M3");
  EXPECT_EQ(view.at("mirrors").at(2).at("outline_in_array_mm").size(), 4u);
  EXPECT_EQ(json.at("pairs").at(0).at("sharp_arc_mm"), *design.pairs[0].sharp_arc_mm);
  EXPECT_EQ(json.at("sensitivities").size(), 36u);
  EXPECT_EQ(json.at("checks").size(), design.checks.size());
  EXPECT_EQ(json.at("all_hold"), true);
}

TEST(DesignJson, SameRigSameBytes) {
  EXPECT_EQ(DesignJson(PaperRig(), PaperDesign()), DesignJson(PaperRig(), PaperDesign()));
}

TEST(DesignTables, ColumnsAreAlignedAndAscii) {
  const RigDesign design = PaperDesign();
  const auto lines = DesignTables(PaperRig(), design);
  const auto at = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
    return line.starts_with("light of");
  });
  ASSERT_NE(at, lines.end());
  for (int i = 1; i <= 4; ++i) EXPECT_EQ(at[i].size(), at[0].size());
  for (const std::string& line : lines) {
    EXPECT_TRUE(std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; }))
        << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
    EXPECT_LE(line.size(), 120u) << line;
  }
}

TEST(DesignTables, EveryCheckIsALineWithItsVerdict) {
  RigDesign design = PaperDesign();
  design.checks.front().ok = false;
  const auto lines = DesignTables(PaperRig(), design);
  const auto count = [&](const std::string& end) {
    return std::count_if(lines.begin(), lines.end(),
                         [&](const std::string& line) { return line.ends_with(end); });
  };
  EXPECT_EQ(count("FAILS"), 1);
  EXPECT_EQ(count("holds"), static_cast<long>(design.checks.size()) - 1);
}

}  // namespace
}  // namespace telestrain
