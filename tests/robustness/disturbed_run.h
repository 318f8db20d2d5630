#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "integration/small_run.h"
#include "unit/base/scratch_folder.h"

namespace telestrain::testing_support {

// Runs that are disturbed, beside the results of one that was not.
class Faults : public SmallRun {
 protected:
  static const std::filesystem::path& Scratch() {
    static const ScratchFolder scratch("telestrain_faults_");
    return scratch.path();
  }
  // The finished results, to be spoiled.
  static std::filesystem::path Copy(const std::string& name) {
    std::filesystem::copy(Results(), Scratch() / name, std::filesystem::copy_options::recursive);
    return Scratch() / name;
  }
  static std::vector<std::string> RunInto(const std::filesystem::path& out) {
    return {"run", SmallSession().string(), "--out", out.string()};
  }
  static void ExpectAsUndisturbed(const std::filesystem::path& out) {
    EXPECT_EQ(DifferingFiles(Results(), out), std::vector<std::string>());
  }
  // A line of bash with $TELESTRAIN, $SESSION and $OUT.
  static ProgramRun Shell(const std::string& line, const std::filesystem::path& out) {
    return RunProgram({"/bin/bash", "-c", line}, {".",
                                                  {{"TELESTRAIN", TelestrainPath().string()},
                                                   {"SESSION", SmallSession().string()},
                                                   {"OUT", out.string()}}});
  }
};

}  // namespace telestrain::testing_support
