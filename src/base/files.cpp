#include "base/files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>
#include <vector>

#include "base/descriptor.h"
#include "base/numbers.h"
#include "base/signals.h"

namespace telestrain {
namespace {

// What stands between a file's name and the number of the process that is writing it.
constexpr const char* kTemporaryMark = ".telestrain-part-";

std::string Reason(int error_number) { return std::strerror(error_number); }

// The number of the process that a temporary file is of, nothing for another name.
std::optional<int> WriterOf(const std::string& name) {
  const std::size_t mark = name.rfind(kTemporaryMark);
  if (mark == std::string::npos || mark == 0) return {};
  const std::string rest = name.substr(mark + std::string_view(kTemporaryMark).size());
  const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
  if (digits == 0 || (digits < rest.size() && rest[digits] != '.')) return {};
  return ParseInt(rest.substr(0, digits));
}

// Whether it is another process that lives.
bool Runs(int process) {
  return process != ::getpid() && (::kill(process, 0) == 0 || errno == EPERM);
}

// Returns 0 or errno.
int WriteAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

// Makes a file that must not exist. `mode`: its permissions, else what the system makes of 0644.
// Returns 0 or the errno of the first call that failed.
int WriteNewFile(const std::filesystem::path& path, std::string_view bytes,
                 std::optional<mode_t> mode) {
  Descriptor file{::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_EXCL | O_NOFOLLOW,
                         mode ? 0600 : 0644)};
  if (file.value < 0) return errno;
  if (mode && ::fchmod(file.value, *mode) != 0) return errno;
  if (const int failed = WriteAll(file.value, bytes)) return failed;
  if (::fsync(file.value) != 0) return errno;
  return file.Close();
}

// A part that was written goes again. Returns 0 or errno.
int WriteAtEnd(const std::filesystem::path& path, std::string_view bytes) {
  Descriptor file{::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_APPEND, 0644)};
  if (file.value < 0) return errno;
  struct stat before {};
  if (::fstat(file.value, &before) != 0) return errno;
  int failed = WriteAll(file.value, bytes);
  if (failed == 0 && ::fsync(file.value) != 0) failed = errno;
  if (failed == 0) return file.Close();
  [[maybe_unused]] const int cut = ::ftruncate(file.value, before.st_size);
  return failed;
}

// The permissions of the file that is to be replaced; nothing without one.
std::optional<mode_t> ModeOf(const std::filesystem::path& path) {
  struct stat facts {};
  if (::lstat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
  return facts.st_mode & 0777;
}

// What to do about a write that failed.
std::string RemedyOf(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose a folder on another disk";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to";
    case EIO:
      return "the disk or its connection fails: look after it, or choose a folder on another disk";
    case EFBIG:
      return "allow larger files (ulimit -f) or choose another disk";
    case ENOENT:
    case ENOTDIR:
      return "make the folder first, or choose another one";
    case EISDIR:
    case EEXIST:
    case ENOTEMPTY:
      return "a folder is in the way: move it, or choose another place";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EMFILE:
    case ENFILE:
      return "too many files are open: allow more (ulimit -n) or end other programs";
    case ENOMEM:
      return "end other programs or allow more memory (ulimit -v)";
    default:
      return "choose another folder";
  }
}

}  // namespace

Error CannotWrite(const std::filesystem::path& path, int error_number) {
  return OutputFailed(path.string() + ": cannot be written: " + Reason(error_number) + "; " +
                      RemedyOf(error_number));
}

Error CannotRemove(const std::filesystem::path& path, const std::string& what, int error_number) {
  return OutputFailed(path.string() + ": " + what + " cannot be removed: " + Reason(error_number) +
                      "; " + RemedyOf(error_number));
}

Status WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  const NoSignalNow whole;
  const std::filesystem::path temporary = TemporaryFor(path);
  int error_number = WriteNewFile(temporary, bytes, ModeOf(path));
  if (error_number == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error_number = errno;
  if (error_number == 0) return {};
  ::unlink(temporary.c_str());
  return CannotWrite(path, error_number);
}

Status AppendToFile(const std::filesystem::path& path, std::string_view bytes) {
  const NoSignalNow whole;
  const int error_number = WriteAtEnd(path, bytes);
  return error_number == 0 ? Status{} : Status{CannotWrite(path, error_number)};
}

std::filesystem::path TemporaryFor(const std::filesystem::path& path, const std::string& ending) {
  std::filesystem::path temporary = path;
  temporary += kTemporaryMark + std::to_string(::getpid()) + ending;
  ::unlink(temporary.c_str());  // a link of that name is not followed
  return temporary;
}

bool IsTemporary(const std::string& name) { return WriterOf(name).has_value(); }

Status RemoveTemporaries(const std::filesystem::path& folder) {
  std::error_code code;
  std::vector<std::filesystem::path> left;
  for (std::filesystem::directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code))
    if (const auto writer = WriterOf(entry->path().filename().string()); writer && !Runs(*writer))
      left.push_back(entry->path());
  for (const auto& path : left)
    if (!std::filesystem::remove(path, code) && code)
      return CannotRemove(path, "what a killed program left", code.value());
  return {};
}

Status EnsureFolder(const std::filesystem::path& path) {
  std::error_code code;
  std::filesystem::create_directories(path, code);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return {};
  if (std::filesystem::exists(path, ignored))
    return OutputFailed(path.string() + ": cannot be made a folder: a file has that name; choose " +
                        "another name");
  return OutputFailed(path.string() +
                      ": cannot be made a folder: " + (code ? code.message() : Reason(ENOENT)) +
                      "; " + RemedyOf(code ? code.value() : ENOENT));
}

}  // namespace telestrain
