#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"

namespace telestrain {

// Holds a file or a folder for this process while it lives, so that two programs do not both read
// and continue the same thing. Others wait. It is advisory (flock): it holds against programs that
// take it too, and one object at a time holds a path, also within a process.
class PathLock {
 public:
  // A file that does not exist is made; a folder must exist. Fails (kOutputFailed) with the path,
  // the reason and `remedy`.
  static Result<PathLock> Take(const std::filesystem::path& path, const std::string& remedy);

  PathLock(PathLock&& other) noexcept;
  PathLock(const PathLock&) = delete;
  PathLock& operator=(const PathLock&) = delete;
  ~PathLock();

 private:
  explicit PathLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace telestrain
