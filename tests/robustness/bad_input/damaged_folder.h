#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "base/result.h"
#include "cli/program_run.h"
#include "robustness/bad_input/damage.h"

namespace telestrain::testing_support {

// A folder whose files are damaged one at a time and put back as they were.
class DamagedFolder {
 public:
  explicit DamagedFolder(std::filesystem::path folder);

  const std::filesystem::path& path() const { return folder_; }
  std::string Bytes(const std::string& file) const { return before_.at(file); }

  // Nothing when the reader took the file, else how it refused it.
  using Reader = std::function<std::optional<Error>()>;
  // For each damage: `read` either takes the file or refuses it as bad input or too little to
  // estimate from (exit codes 3 and 4), in words that name `file` and a remedy (what follows a
  // ';'); nothing is written to stderr beside and, when it refuses, no byte of the folder changes.
  // Gives the number of refusals.
  int ExpectRefusedOrTaken(const std::string& file, const std::vector<Damaged>& damages,
                           const Reader& read);

 private:
  void Write(const std::string& file, const std::string& bytes) const;
  void PutBack();

  std::filesystem::path folder_;
  std::map<std::string, std::string> before_;
};

// What is wrong with the words of a refusal; empty: nothing.
std::string FaultOfMessage(const std::string& message, const std::string& file);

}  // namespace telestrain::testing_support
