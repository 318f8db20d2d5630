#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace telestrain::testing_support {

// What a finished run of the program left behind. A run that a signal ended has 128 + the signal.
struct ProgramRun {
  int exit_code = -1;
  std::string out;
  std::string err;
  long peak_memory_kib = 0;  // resident
};

// Where the program runs.
struct Surroundings {
  std::filesystem::path folder = ".";                             // working folder
  std::map<std::string, std::optional<std::string>> environment;  // set, or unset without a value
  bool one_processor = false;  // the program may use one processor only
};

// Runs the telestrain of this build with its output caught; its stderr is no terminal.
ProgramRun RunTelestrain(const std::vector<std::string>& arguments, const Surroundings& where = {});

// The same for any program; the first word is its path.
ProgramRun RunProgram(const std::vector<std::string>& words, const Surroundings& where = {});

// The telestrain of this build, running beside the test.
class RunningTelestrain {
 public:
  explicit RunningTelestrain(const std::vector<std::string>& arguments);
  ~RunningTelestrain();  // kills it if it still runs
  RunningTelestrain(const RunningTelestrain&) = delete;
  RunningTelestrain& operator=(const RunningTelestrain&) = delete;
  bool HasEnded();
  void Signal(int number) const;
  std::string ErrSoFar() const;
  ProgramRun Wait();

  struct Child;

 private:
  std::unique_ptr<Child> child_;
};

// Path of the telestrain of this build.
std::filesystem::path TelestrainPath();

// The committed session of data/.
std::filesystem::path SmallSession();

// The bytes of every file below `folder`, by its path inside.
std::map<std::string, std::string> BytesBelow(const std::filesystem::path& folder);

// Names, not bytes, of the files below one of two folders that the other lacks or has otherwise.
std::vector<std::string> DifferingFiles(const std::filesystem::path& a,
                                        const std::filesystem::path& b);

std::string ReadAll(const std::filesystem::path& path);

}  // namespace telestrain::testing_support
