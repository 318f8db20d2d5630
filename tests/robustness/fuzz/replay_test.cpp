// Inputs that once broke a parser, or that lead into its corners, through the fuzz targets. Others
// when the environment's TELESTRAIN_FUZZ_CORPUS names a folder of them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>

#include "robustness/fuzz/fuzz_target.h"

namespace telestrain::fuzz {
namespace {

namespace fs = std::filesystem;

// By the names of the corpus folders.
const std::map<std::string, Target>& Targets() {
  static const std::map<std::string, Target> targets{
      {"text", FuzzText},       {"session", FuzzSession}, {"corners", FuzzCorners},
      {"results", FuzzResults}, {"report", FuzzReport},   {"calibration", FuzzCalibration},
      {"pdf", FuzzPdf},         {"audit", FuzzAudit},     {"signature", FuzzSignature},
      {"image", FuzzImage}};
  return targets;
}

class FuzzCorpus : public ::testing::TestWithParam<std::string> {};

TEST_P(FuzzCorpus, HoldsEveryLaw) {
  const char* other = std::getenv("TELESTRAIN_FUZZ_CORPUS");
  const fs::path kept = fs::path(TELESTRAIN_SOURCE_DIR) / "tests/robustness/fuzz/corpus";
  const fs::path folder = (other ? fs::path(other) : kept) / GetParam();
  ASSERT_TRUE(fs::is_directory(folder)) << folder;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string input{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NO_THROW(Targets().at(GetParam())(input)) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0);
  Targets().at(GetParam())("");
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  for (const auto& [name, target] : Targets()) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, ::testing::ValuesIn(Names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace telestrain::fuzz
