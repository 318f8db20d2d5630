#include "cli/kept_run.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

// Held by the process that looks for a run or makes it.
class Lock {
 public:
  explicit Lock(const fs::path& path) : file_(::open(path.c_str(), O_CREAT | O_RDWR, 0666)) {
    if (file_ < 0 || ::flock(file_, LOCK_EX) != 0)
      throw std::runtime_error("cannot lock " + path.string());
  }
  ~Lock() { ::close(file_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  const int file_;
};

// Another one when the file is another.
std::string StampOf(const fs::path& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) throw std::runtime_error("no file " + path.string());
  std::ostringstream text;
  text << path.string() << ' ' << file.st_ino << ' ' << file.st_size << ' ' << file.st_mtim.tv_sec
       << ' ' << file.st_mtim.tv_nsec << '\n';
  return text.str();
}

std::string StampOfInputs() {
  std::string text = StampOf(TelestrainPath());
  for (const auto& [name, bytes] : BytesBelow(SmallSession()))
    text += name + ' ' + std::to_string(std::hash<std::string>{}(bytes)) + '\n';
  return text;
}

void WriteAll(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

// The run in this folder, which must be finished.
KeptRun Read(const fs::path& folder) {
  return {folder,
          {0, ReadAll(folder / "out"), ReadAll(folder / "err"),
           std::stol(ReadAll(folder / "peak_memory_kib"))}};
}

KeptRun Make(const std::vector<std::string>& verbs, const fs::path& folder) {
  fs::remove_all(folder);
  for (const char* name : {"home", "work"}) fs::create_directories(folder / name);
  const Surroundings where{folder / "work", {{"HOME", (folder / "home").string()}}};
  KeptRun kept{folder, {}};
  for (const std::string& verb : verbs) {
    kept.run = RunTelestrain(
        {verb, SmallSession().string(), "--out", (folder / "results").string()}, where);
    if (kept.run.exit_code != 0) return kept;
  }
  WriteAll(folder / "out", kept.run.out);
  WriteAll(folder / "err", kept.run.err);
  WriteAll(folder / "peak_memory_kib", std::to_string(kept.run.peak_memory_kib));
  return kept;
}

}  // namespace

KeptRun KeptRunOf(const std::vector<std::string>& verbs) {
  const fs::path kept = TELESTRAIN_KEPT_RUNS;
  std::string name;
  for (const std::string& verb : verbs) name += (name.empty() ? "" : "-") + verb;
  fs::create_directories(kept);
  const Lock lock(kept / (name + ".lock"));
  const fs::path folder = kept / name, stamp = kept / (name + ".made_from");
  const std::string inputs = StampOfInputs();
  if (fs::exists(stamp) && ReadAll(stamp) == inputs) return Read(folder);
  fs::remove(stamp);
  const KeptRun made = Make(verbs, folder);
  if (made.run.exit_code == 0) WriteAll(stamp, inputs);  // last: what is cut short is made again
  return made;
}

}  // namespace telestrain::testing_support
