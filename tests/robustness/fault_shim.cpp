// Preloaded into the program by fault_writes and fault_kill: lets the k-th call that writes below a
// folder fail, or kills the process in its place. Says nothing and is told by the environment:
//   FAULT_FOLDER  absolute path, without an end in /
//   FAULT_AT      k, from 1; 0: none
//   FAULT_ERRNO   number of the error; 0: SIGKILL instead
//   FAULT_STAYS   1: every later call fails too, as on a full disk; what removes files goes on
//   FAULT_COUNT   file that gets the number of calls when the process ends
// Calls: open for writing, write, fsync, close, fchmod, ftruncate, rename, mkdir, unlink, remove.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

template <typename Function>
Function* Real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

long NumberIn(const char* name) {
  const char* const text = std::getenv(name);
  return text ? std::atol(text) : 0;
}

struct Plan {
  std::string folder = std::getenv("FAULT_FOLDER") ? std::getenv("FAULT_FOLDER") : "";
  long at = NumberIn("FAULT_AT");
  int error = static_cast<int>(NumberIn("FAULT_ERRNO"));
  bool stays = NumberIn("FAULT_STAYS") != 0;
  std::atomic<long> calls = 0;
  std::array<std::atomic<bool>, 4096> is_ours = {};  // by the descriptor

  ~Plan() {
    const char* const count = std::getenv("FAULT_COUNT");
    if (count == nullptr) return;
    if (std::FILE* file = std::fopen(count, "w")) {
      std::fprintf(file, "%ld\n", calls.load());
      std::fclose(file);
    }
  }
};

Plan& ThePlan() {
  static Plan plan;
  return plan;
}

bool IsBelow(const char* path) {
  const std::string& folder = ThePlan().folder;
  if (path == nullptr || folder.empty()) return false;
  const std::string text = path;
  return text.starts_with(folder) && (text.size() == folder.size() || text[folder.size()] == '/');
}

bool IsOurs(int file) {
  return file >= 0 && file < 4096 && ThePlan().is_ours[static_cast<std::size_t>(file)];
}

void SetOurs(int file, bool is) {
  if (file >= 0 && file < 4096) ThePlan().is_ours[static_cast<std::size_t>(file)] = is;
}

// Whether this call is the one; sets errno.
bool Fails(bool frees_space = false) {
  Plan& plan = ThePlan();
  const long call = ++plan.calls;
  const bool now = call == plan.at || (plan.stays && !frees_space && plan.at > 0 && call > plan.at);
  if (!now) return false;
  if (plan.error == 0) ::kill(::getpid(), SIGKILL);
  errno = plan.error;
  return true;
}

int Open(const char* name, const char* path, int flags, mode_t mode) {
  const bool ours = IsBelow(path) && (flags & O_ACCMODE) != O_RDONLY;
  if (ours && Fails()) return -1;
  const int file = Real<int(const char*, int, ...)>(name)(path, flags, mode);
  SetOurs(file, ours);
  return file;
}

mode_t ModeIn(int flags, va_list more) {
  return (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(more, int)) : 0;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = ModeIn(flags, more);
  va_end(more);
  return Open("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = ModeIn(flags, more);
  va_end(more);
  return Open("open64", path, flags, mode);
}

// A disk that is nearly full takes a part first.
ssize_t write(int file, const void* bytes, size_t count) {
  const auto real = Real<ssize_t(int, const void*, size_t)>("write");
  if (!IsOurs(file) || !Fails()) return real(file, bytes, count);
  const int error = errno;
  [[maybe_unused]] const ssize_t part = real(file, bytes, count / 2);
  errno = error;
  return -1;
}

int fsync(int file) { return IsOurs(file) && Fails() ? -1 : Real<int(int)>("fsync")(file); }

int fchmod(int file, mode_t mode) {
  return IsOurs(file) && Fails() ? -1 : Real<int(int, mode_t)>("fchmod")(file, mode);
}

int ftruncate(int file, off_t length) noexcept {
  return IsOurs(file) && Fails(true) ? -1 : Real<int(int, off_t)>("ftruncate")(file, length);
}

int close(int file) {
  const bool fails = IsOurs(file) && Fails();
  const int error = errno;
  SetOurs(file, false);
  const int closed = Real<int(int)>("close")(file);
  if (!fails) return closed;
  errno = error;
  return -1;
}

int rename(const char* from, const char* to) noexcept {
  return IsBelow(to) && Fails() ? -1 : Real<int(const char*, const char*)>("rename")(from, to);
}

int mkdir(const char* path, mode_t mode) noexcept {
  return IsBelow(path) && Fails() ? -1 : Real<int(const char*, mode_t)>("mkdir")(path, mode);
}

// Only of what is there: programs ask for the removal of what may not be.
int unlink(const char* path) noexcept {
  const bool counts = IsBelow(path) && ::access(path, F_OK) == 0;
  return counts && Fails(true) ? -1 : Real<int(const char*)>("unlink")(path);
}

int remove(const char* path) noexcept {
  const bool counts = IsBelow(path) && ::access(path, F_OK) == 0;
  return counts && Fails(true) ? -1 : Real<int(const char*)>("remove")(path);
}

}  // extern "C"
