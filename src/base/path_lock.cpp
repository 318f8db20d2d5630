#include "base/path_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace telestrain {

Result<PathLock> PathLock::Take(const std::filesystem::path& path, const std::string& remedy) {
  std::error_code code;
  const bool is_folder = std::filesystem::is_directory(path, code);
  PathLock lock(is_folder ? ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)
                          : ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (lock.descriptor_ >= 0) {
    int failed = 0;
    do {
      failed = ::flock(lock.descriptor_, LOCK_EX);
    } while (failed != 0 && errno == EINTR);
    if (failed == 0) return lock;
  }
  return OutputFailed(path.string() + ": cannot be locked: " + std::strerror(errno) + "; " +
                      remedy);
}

PathLock::PathLock(PathLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

PathLock::~PathLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace telestrain
