#pragma once

#include <filesystem>
#include <memory>

#include "base/path_lock.h"
#include "base/result.h"

namespace telestrain {

// Holds a results folder for this process while a verb writes into it. Objects of one process share
// it: a step takes it again inside a verb that has it.
class ResultsLock {
 public:
  // Fails at once (kOutputFailed) when another process holds the folder, with its number. A folder
  // that does not exist is not held; take it again when it is made. Removes what killed programs
  // left half-written.
  static Result<ResultsLock> Take(const std::filesystem::path& results);

 private:
  explicit ResultsLock(std::shared_ptr<const PathLock> lock) : lock_(std::move(lock)) {}
  std::shared_ptr<const PathLock> lock_;
};

}  // namespace telestrain
