#pragma once

#include <filesystem>
#include <string>

#include "cli/program_run.h"

namespace telestrain::testing_support {

// Runs the commands of documents as a reader would: by bash, `telestrain` found by its name, in a
// folder where build/release, data and templates are those of this build and its sources.
class DocumentShell {
 public:
  explicit DocumentShell(const std::filesystem::path& folder);  // emptied first
  // Output and messages come together in `out`, in their order.
  ProgramRun Run(const std::string& command) const;

  // The command whose results are made once and copied for every document that wants them.
  static const std::string& SharedCommand();

 private:
  ProgramRun RunByBash(const std::string& command) const;

  std::filesystem::path folder_;
};

}  // namespace telestrain::testing_support
