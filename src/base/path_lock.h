#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"

namespace telestrain {

// Holds a file or a folder for this process while it lives, so that two programs do not both read
// and continue the same thing. It is advisory (flock): it holds against programs that take it too,
// and one object at a time holds a path, also within a process. The system lets go of it when the
// process ends, however that may be, and nothing is written for it.
class PathLock {
 public:
  // Waits while another holds it. A file that does not exist is made; a folder must exist. Fails
  // (kOutputFailed) with the path and the reason, and with `remedy` when another holds it.
  static Result<PathLock> Take(const std::filesystem::path& path, const std::string& remedy);
  // Does not wait: fails (kOutputFailed) when another holds it, with the number of that process
  // where the system tells it.
  static Result<PathLock> TakeAtOnce(const std::filesystem::path& path, const std::string& remedy);

  PathLock(PathLock&& other) noexcept;
  PathLock(const PathLock&) = delete;
  PathLock& operator=(const PathLock&) = delete;
  ~PathLock();

 private:
  explicit PathLock(int descriptor) : descriptor_(descriptor) {}
  static Result<PathLock> Lock(const std::filesystem::path& path, const std::string& remedy,
                               int how);
  int descriptor_;
};

}  // namespace telestrain
