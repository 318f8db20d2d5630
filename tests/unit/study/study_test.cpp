#include "study/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/unit/base/scratch_folder.h"

namespace telestrain {
namespace {

Error ErrorOf(const std::string& name, const StudyOptions& options) {
  std::ostringstream text;
  Console console(text, text, false);
  const auto result = RunStudy(name, options, "never-made", console);
  EXPECT_FALSE(result.ok());
  EXPECT_FALSE(std::filesystem::exists("never-made"));
  return result.ok() ? Error{} : result.error();
}

TEST(Study, AnUnknownNameIsAUsageErrorThatNamesTheNearest) {
  const Error error = ErrorOf("paper-stain", {});
  EXPECT_EQ(error.kind, ErrorKind::kUsage);
  EXPECT_NE(error.message.find("'paper-strain'"), std::string::npos);
}

TEST(Study, OptionsOutsideTheirRangeAreUsageErrors) {
  StudyOptions options;
  options.share = 1.5;
  EXPECT_NE(ErrorOf("sensitivity", options).message.find("--share is 1.5"), std::string::npos);
  options = {};
  options.binning = 5;
  EXPECT_NE(ErrorOf("sensitivity", options).message.find("--binning is 5"), std::string::npos);
  options = {};
  options.threads = -1;
  EXPECT_NE(ErrorOf("sensitivity", options).message.find("--threads is -1"), std::string::npos);
}

TEST(Study, TheResultNamesItsOptions) {
  StudyOptions options;
  options.share = 0.02;
  options.seed = 7;
  std::ostringstream text;
  Console console(text, text, false);
  const ScratchFolder scratch("telestrain_study_options_");
  const auto result = RunStudy("convergence", options, scratch.path(), console);
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_EQ(result->notes.front(), "A quick look with 2 % of the full size.");
  const auto seed = std::find_if(result->settings.begin(), result->settings.end(),
                                 [](const StudySetting& s) { return s.name == "seed"; });
  ASSERT_NE(seed, result->settings.end());
  EXPECT_EQ(seed->value, "7");
  // More poses leave less of the calibration's error: as 1 / sqrt of their number, 24 times here.
  const auto& rows = result->tables.front().rows;
  const double few = std::get<StudyNumber>(rows.front()[5]).value;
  const double many = std::get<StudyNumber>(rows.back()[5]).value;
  EXPECT_LT(many, 0.6 * few);
}

TEST(Study, AShareScalesCountsDownToTheLeast) {
  StudyOptions options;
  options.share = 0.1;
  EXPECT_EQ(options.Scaled(1200, 6), 120);
  EXPECT_EQ(options.Scaled(36, 6), 6);
}

}  // namespace
}  // namespace telestrain
