#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/program_run.h"

namespace telestrain::testing_support {

// One `telestrain run` on the small session, shared by all tests of all programs; not to be written
// to.
class SmallRun : public ::testing::Test {
 protected:
  static void SetUpTestSuite();

  // The folder that holds the results and the empty folders `home` and `work` of the run.
  static const std::filesystem::path& Folder();
  static std::filesystem::path Results() { return Folder() / "results"; }
  static const ProgramRun& Run();
  static const nlohmann::json& Truth();
  static nlohmann::json ResultJson(const std::string& name);
};

}  // namespace telestrain::testing_support
