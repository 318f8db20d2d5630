#include "base/path_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

namespace telestrain {
namespace {

// "process 4711", as the kernel's list of locks has it: "1: FLOCK ADVISORY WRITE 4711 fd:00:123 0
// EOF". A process of another container has no number here.
std::string HolderOf(int descriptor) {
  struct stat file {};
  if (::fstat(descriptor, &file) != 0) return "another program";
  std::array<char, 64> place{};
  std::snprintf(place.data(), place.size(), "%02x:%02x:%llu", major(file.st_dev),
                minor(file.st_dev), static_cast<unsigned long long>(file.st_ino));
  std::ifstream list("/proc/locks");
  for (std::string line; std::getline(list, line);) {
    std::istringstream words(line);
    std::string number, kind, strength, access, process, where;
    words >> number >> kind >> strength >> access >> process >> where;
    if (kind == "FLOCK" && where == place.data() && process.find_first_not_of('0') == 0)
      return "process " + process;
  }
  return "another program";
}

}  // namespace

Result<PathLock> PathLock::Lock(const std::filesystem::path& path, const std::string& remedy,
                                int how) {
  std::error_code code;
  const bool is_folder = std::filesystem::is_directory(path, code);
  PathLock lock(is_folder ? ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)
                          : ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (lock.descriptor_ >= 0) {
    int failed = 0;
    do {
      failed = ::flock(lock.descriptor_, how);
    } while (failed != 0 && errno == EINTR);
    if (failed == 0) return lock;
    if (errno == EWOULDBLOCK)
      return OutputFailed(path.string() + ": is in use by " + HolderOf(lock.descriptor_) + "; " +
                          remedy);
  }
  return OutputFailed(path.string() + ": cannot be locked: " + std::strerror(errno) +
                      "; choose a place on a local disk that you may read and write");
}

Result<PathLock> PathLock::Take(const std::filesystem::path& path, const std::string& remedy) {
  return Lock(path, remedy, LOCK_EX);
}

Result<PathLock> PathLock::TakeAtOnce(const std::filesystem::path& path,
                                      const std::string& remedy) {
  return Lock(path, remedy, LOCK_EX | LOCK_NB);
}

PathLock::PathLock(PathLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

PathLock::~PathLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace telestrain
