#include "base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>

#include "base/descriptor.h"

namespace telestrain {
namespace {

std::string Reason(int error_number) { return std::strerror(error_number); }

// `flags`: of open(), beside those for writing. `mode`: of the new file, else what the system makes
// of 0644. Returns 0 or the errno of the first call that failed.
int WriteAndSync(const std::filesystem::path& path, std::string_view bytes, int flags,
                 std::optional<mode_t> mode = std::nullopt) {
  Descriptor file{::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, mode ? 0600 : 0644)};
  if (file.value < 0) return errno;
  if (mode && ::fchmod(file.value, *mode) != 0) return errno;
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.value, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(file.value) == 0 ? 0 : errno;
}

// The permissions of the file that is to be replaced; nothing without one.
std::optional<mode_t> ModeOf(const std::filesystem::path& path) {
  struct stat facts {};
  if (::lstat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
  return facts.st_mode & 0777;
}

Error CannotWrite(const std::filesystem::path& path, int error_number) {
  return OutputFailed(path.string() + ": cannot be written: " + Reason(error_number) +
                      "; free some space or choose another --out folder");
}

}  // namespace

Status WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  std::filesystem::path temporary = path;
  temporary += ".part" + std::to_string(::getpid());
  // A killed program of the same number may have left one; a link of that name is not followed.
  ::unlink(temporary.c_str());
  int error_number = WriteAndSync(temporary, bytes, O_EXCL | O_NOFOLLOW, ModeOf(path));
  if (error_number == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error_number = errno;
  if (error_number == 0) return {};
  ::unlink(temporary.c_str());
  return CannotWrite(path, error_number);
}

Status AppendToFile(const std::filesystem::path& path, std::string_view bytes) {
  const int error_number = WriteAndSync(path, bytes, O_APPEND);
  return error_number == 0 ? Status{} : Status{CannotWrite(path, error_number)};
}

Status EnsureFolder(const std::filesystem::path& path) {
  std::error_code code;
  std::filesystem::create_directories(path, code);
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored))
    return OutputFailed(path.string() + ": cannot be made a folder" +
                        (code ? ": " + code.message() : std::string{}));
  return {};
}

}  // namespace telestrain
