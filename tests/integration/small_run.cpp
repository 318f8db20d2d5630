#include "integration/small_run.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

struct Shared {
  ScratchFolder scratch{"telestrain_small_run_"};
  ProgramRun run;
  nlohmann::json truth;

  Shared() {
    const fs::path home = scratch.path() / "home", work = scratch.path() / "work";
    fs::create_directories(home);
    fs::create_directories(work);
    const Surroundings where{work, {{"HOME", home.string()}}};
    run = RunTelestrain(
        {"run", SmallSession().string(), "--out", (scratch.path() / "results").string()}, where);
    truth = nlohmann::json::parse(ReadAll(SmallSession().string() + "-truth.json"));
  }
};

const Shared& TheRun() {
  static const Shared shared;
  return shared;
}

}  // namespace

void SmallRun::SetUpTestSuite() { ASSERT_EQ(Run().exit_code, 0) << Run().err; }

const fs::path& SmallRun::Scratch() { return TheRun().scratch.path(); }

const ProgramRun& SmallRun::Run() { return TheRun().run; }

const nlohmann::json& SmallRun::Truth() { return TheRun().truth; }

nlohmann::json SmallRun::ResultJson(const std::string& name) {
  return nlohmann::json::parse(ReadAll(Results() / name));
}

}  // namespace telestrain::testing_support
