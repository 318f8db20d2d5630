#include "integration/small_run.h"

#include "cli/kept_run.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

const KeptRun& TheRun() {
  static const KeptRun kept = KeptRunOf({"run"});
  return kept;
}

}  // namespace

void SmallRun::SetUpTestSuite() { ASSERT_EQ(Run().exit_code, 0) << Run().err; }

const fs::path& SmallRun::Folder() { return TheRun().folder; }

const ProgramRun& SmallRun::Run() { return TheRun().run; }

const nlohmann::json& SmallRun::Truth() {
  static const auto truth = nlohmann::json::parse(ReadAll(SmallSession().string() + "-truth.json"));
  return truth;
}

nlohmann::json SmallRun::ResultJson(const std::string& name) {
  return nlohmann::json::parse(ReadAll(Results() / name));
}

}  // namespace telestrain::testing_support
