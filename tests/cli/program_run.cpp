#include "cli/program_run.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

// A file without a name that takes what a program prints.
class Catch {
 public:
  Catch() : file_(std::tmpfile(), &std::fclose) {
    if (!file_) throw std::runtime_error("no temporary file");
  }
  int Descriptor() const { return ::fileno(file_.get()); }
  // Leaves the place where the program writes on, which is shared with it.
  std::string Text() const {
    std::string text;
    std::array<char, 4096> part{};
    for (ssize_t got = 1; got > 0; text.append(part.data(), got))
      got = std::max<ssize_t>(
          0, ::pread(Descriptor(), part.data(), part.size(), static_cast<off_t>(text.size())));
    return text;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

void UseOneProcessor() {
  cpu_set_t allowed, one;
  CPU_ZERO(&one);
  ::sched_getaffinity(0, sizeof(allowed), &allowed);
  for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++i)
    if (CPU_ISSET(i, &allowed)) CPU_SET(i, &one);
  ::sched_setaffinity(0, sizeof(one), &one);
}

// Becomes the program, in the child process.
[[noreturn]] void Become(const std::vector<std::string>& words, const Surroundings& where,
                         const Catch& out, const Catch& err) {
  if (::chdir(where.folder.c_str()) != 0) ::_exit(126);
  for (const auto& [name, value] : where.environment)
    value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
  if (where.one_processor) UseOneProcessor();
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(out.Descriptor(), STDOUT_FILENO);
  ::dup2(err.Descriptor(), STDERR_FILENO);
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  ::execv(pointers[0], pointers.data());
  ::_exit(127);
}

std::vector<std::string> WordsOf(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{TelestrainPath().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

}  // namespace

struct RunningTelestrain::Child {
  Catch out, err;
  pid_t id = -1;
  bool ended = false;
  ProgramRun run;

  Child(const std::vector<std::string>& words, const Surroundings& where) {
    id = ::fork();
    if (id < 0) throw std::runtime_error("no new process");
    if (id == 0) Become(words, where, out, err);
  }
  void Wait(int options) {
    int status = 0;
    rusage used{};
    if (ended || ::wait4(id, &status, options, &used) != id) return;
    ended = true;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run = {code, out.Text(), err.Text(), used.ru_maxrss};
  }
};

RunningTelestrain::RunningTelestrain(const std::vector<std::string>& arguments)
    : child_(std::make_unique<Child>(WordsOf(arguments), Surroundings{})) {}

RunningTelestrain::~RunningTelestrain() {
  if (HasEnded()) return;
  Signal(SIGKILL);
  Wait();
}

bool RunningTelestrain::HasEnded() {
  child_->Wait(WNOHANG);
  return child_->ended;
}

void RunningTelestrain::Signal(int number) const {
  if (!child_->ended) ::kill(child_->id, number);
}

std::string RunningTelestrain::ErrSoFar() const { return child_->err.Text(); }

ProgramRun RunningTelestrain::Wait() {
  child_->Wait(0);
  return child_->run;
}

ProgramRun RunProgram(const std::vector<std::string>& words, const Surroundings& where) {
  RunningTelestrain::Child child(words, where);
  child.Wait(0);
  return child.run;
}

ProgramRun RunTelestrain(const std::vector<std::string>& arguments, const Surroundings& where) {
  return RunProgram(WordsOf(arguments), where);
}

fs::path TelestrainPath() { return TELESTRAIN_PROGRAM; }

fs::path SmallSession() { return fs::path(TELESTRAIN_SOURCE_FOLDER) / "data/small_session"; }

std::string ReadAll(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

std::map<std::string, std::string> BytesBelow(const fs::path& folder) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      bytes[fs::relative(entry.path(), folder).generic_string()] = ReadAll(entry.path());
  return bytes;
}

std::vector<std::string> DifferingFiles(const fs::path& a, const fs::path& b) {
  const auto first = BytesBelow(a), second = BytesBelow(b);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : first) {
    const auto other = second.find(name);
    if (other == second.end() || other->second != bytes) names.push_back(name);
  }
  for (const auto& [name, bytes] : second)
    if (!first.contains(name)) names.push_back(name);
  return names;
}

}  // namespace telestrain::testing_support
