// `review` makes one file of a results folder that is complete and of one piece.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Without pipe images, which the page does not need.
class ReviewVerb : public SessionCopy {
 protected:
  ReviewVerb() {
    Remove("pipe.csv");
    Replace("session.toml", "strain_error_microstrain = 20.0\n", "");
    MustRun({"detect", "calibrate"});
  }
  ProgramRun Review() const { return RunTelestrain({"review", results().string()}); }
  int Report() const { return RunTelestrain({"report", results().string()}).exit_code; }
  void ExpectRefused(const std::string& part) const {
    const ProgramRun run = Review();
    EXPECT_EQ(run.exit_code, 3) << run.out;
    EXPECT_TRUE(Holds(run.err, part)) << run.err;
    EXPECT_FALSE(fs::exists(page()));
  }
  fs::path page() const { return results() / "review.html"; }
};

TEST_F(ReviewVerb, WritesOneFileWithTheSameBytesEveryTime) {
  ASSERT_EQ(RunTelestrain({"render", results().string()}).exit_code, 0);
  Report();
  fs::remove(results() / "pictures" / "top.png");  // is drawn again, and the report stays
  const std::string report = ReadAll(results() / "report.pdf");
  const ProgramRun run = Review();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(Holds(run.out, "review     " + page().string() + ", ")) << run.out;
  const std::string bytes = ReadAll(page());
  EXPECT_TRUE(bytes.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(Holds(bytes, "data:image/png;base64,"));
  EXPECT_TRUE(fs::exists(results() / "pictures" / "top.png"));
  EXPECT_EQ(ReadAll(results() / "report.pdf"), report);
  auto before = BytesBelow(results());
  const fs::path other = scratch() / "other.html", none = scratch() / "none" / "page.html";
  const auto write_to = [&](const fs::path& path) {
    return RunTelestrain({"review", results().string(), "--out", path.string()}).exit_code;
  };
  EXPECT_EQ(write_to(other), 0);
  EXPECT_EQ(ReadAll(other), bytes);
  EXPECT_EQ(write_to(none), 5);
  auto after = BytesBelow(results());
  for (auto* files : {&before, &after}) files->erase("audit.jsonl");  // tells of every page
  EXPECT_TRUE(after == before);
}

TEST_F(ReviewVerb, NeedsAReportOfTheSameRun) {
  ExpectRefused("run 'telestrain report' first");
  Report();
  std::ofstream(results() / "residuals.csv", std::ios::app) << "\n";
  ExpectRefused("was made from another residuals.csv than the one that lies beside it");
}

TEST_F(ReviewVerb, DamagedResultsAreNamedWithTheFieldAndTheRemedy) {
  Report();
  const auto json = nlohmann::ordered_json::parse(ReadAll(results() / "results.json"));
  const auto expect_refused = [&](const nlohmann::ordered_json& damaged, const std::string& named) {
    std::ofstream(results() / "results.json") << damaged;
    ExpectRefused((results() / "results.json").string() + ": " + named);
    ExpectRefused("run 'telestrain report' again");
  };
  auto damaged = json;
  damaged.erase("tables");
  expect_refused(damaged, "tables: is missing");
  damaged = json;
  damaged["tables"][0].erase("rows");
  expect_refused(damaged, "tables[0].rows: is missing");
  damaged = json;
  damaged["tables"][0]["rows"] = 3;
  expect_refused(damaged, "tables[0].rows: a list is wanted, found 3");
}

TEST_F(ReviewVerb, EveryEarlierStepRemovesThePage) {
  const auto page_survives = [&](const auto& step) {
    std::ofstream(page()) << "old";
    step();
    return fs::exists(page());
  };
  EXPECT_FALSE(page_survives([&] { Report(); }));
  EXPECT_FALSE(page_survives([&] { MustRun({"verify"}); }));
  EXPECT_FALSE(page_survives([&] { MustRun({"calibrate"}); }));
}

}  // namespace
}  // namespace telestrain::testing_support
