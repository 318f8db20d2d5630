#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/program_run.h"

namespace telestrain::testing_support {

// What verbs of the program made of the small session. `folder` holds `results`, and the empty
// folders `home` and `work` that the program ran in. Not to be written to: tests copy.
struct KeptRun {
  std::filesystem::path folder;
  ProgramRun run;  // of the last verb
};

// Runs the verbs in turn on the small session, each with --out, and keeps the outcome below the
// build tree for all tests of all programs, one process making it while others wait: every test of
// ctest is a process of its own. Made anew when the program or the session is another. What ends
// with another code than 0 is not kept; the rest of the verbs is left out.
KeptRun KeptRunOf(const std::vector<std::string>& verbs);

}  // namespace telestrain::testing_support
