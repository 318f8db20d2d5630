#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "cli/program_run.h"
#include "desk/x_server.h"
#include "visual/results_fixture.h"

namespace telestrain {
namespace {

using testing_support::ProgramRun;
using testing_support::RunProgram;
using testing_support::Surroundings;

// A results folder with a pipe, made up.
std::filesystem::path Results(const std::string& name) {
  const auto folder = visual_test::FreshFolder(name);
  visual_test::WriteResults(folder);
  return folder;
}

ProgramRun View(std::vector<std::string> words, const Surroundings& where = {}) {
  words.insert(words.begin(), TELESTRAIN_VIEW_PROGRAM);
  return RunProgram(words, where);
}

TEST(TelestrainView, WithoutADisplayEndsWith5AndTheRemedies) {
  const auto results = Results("ViewNoDisplay").string();
  for (const std::optional<std::string>& display :
       {std::optional<std::string>{}, std::optional<std::string>{":4711"}}) {
    const ProgramRun run = View({results}, {.environment = {{"DISPLAY", display}}});
    EXPECT_EQ(run.exit_code, 5) << run.err;
    for (const char* named : {"DISPLAY", "telestrain review", "telestrain render"})
      EXPECT_NE(run.err.find(named), std::string::npos) << run.err;
  }
}

TEST(TelestrainView, BadResultsEndWith3AndBadWordsWith2) {
  EXPECT_EQ(View({"/nonexistent"}).exit_code, 3);
  const auto results = Results("ViewBadWords").string();
  EXPECT_EQ(View({}).exit_code, 2);
  EXPECT_EQ(View({results, "--view", "5"}).exit_code, 2);
  EXPECT_EQ(View({results, "--size", "900"}).exit_code, 2);
  const ProgramRun state = View({results, "--state", "7"});
  EXPECT_EQ(state.exit_code, 2);
  EXPECT_NE(state.err.find("--state 7"), std::string::npos) << state.err;
  const ProgramRun quantity = View({results, "--quantity", "axial"});
  EXPECT_EQ(quantity.exit_code, 2);
  EXPECT_NE(quantity.err.find("axial_microstrain"), std::string::npos) << quantity.err;
}

// As 'telestrain render' says it: the made-up ruler.json belongs to another calibration.json.
TEST(TelestrainView, ResultsThatDoNotBelongTogetherEndWith3) {
  const auto results = Results("ViewOtherCalibration");
  auto ruler = nlohmann::ordered_json::parse(testing_support::ReadAll(results / "ruler.json"));
  const auto view = [&](const std::string& calibration) {
    ruler["made_from"] = {{"calibration.json", Sha256Hex(calibration)}};
    std::ofstream(results / "ruler.json") << ruler;
    return View({results.string()}, {.environment = {{"DISPLAY", std::nullopt}}});
  };
  const std::string calibration = testing_support::ReadAll(results / "calibration.json");
  EXPECT_EQ(view(calibration).exit_code, 5);  // comes as far as the display
  const ProgramRun other = view(calibration + "\n");
  EXPECT_EQ(other.exit_code, 3);
  const std::string named = (results / "ruler.json").string() +
                            ": was made from another calibration.json than the one that lies "
                            "beside it; run 'telestrain verify' again";
  EXPECT_NE(other.err.find(named), std::string::npos) << other.err;
}

TEST(TelestrainView, HelpAndVersionNeedNoDisplay) {
  const Surroundings nowhere{.environment = {{"DISPLAY", std::nullopt}}};
  const ProgramRun help = View({"--help"}, nowhere);
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find("Exit codes: 0 done"), std::string::npos) << help.out;
  EXPECT_TRUE(View({"--version"}, nowhere).out.starts_with("telestrain-view 0."));
}

TEST(TelestrainView, ScreenshotIsTheSameEveryTimeAndAnotherFromAnotherSide) {
  const desk_test::XServer server;
  if (!server.problem().empty()) GTEST_SKIP() << server.problem();
  const auto results = Results("ViewScreenshot");
  const auto shoot = [&](const std::string& name, const std::string& view) {
    const auto path = results / name;
    const ProgramRun run = View(
        {results.string(), "--view", view, "--size", "900x600", "--screenshot", path.string()});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return testing_support::ReadAll(path);
  };
  const std::string first = shoot("first.png", "4");
  EXPECT_GT(first.size(), 10000U);
  EXPECT_EQ(first, shoot("second.png", "4"));
  EXPECT_NE(first, shoot("top.png", "3"));
}

}  // namespace
}  // namespace telestrain
