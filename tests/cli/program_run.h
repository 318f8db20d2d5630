#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace telestrain::testing_support {

// What a finished run of the program left behind. A run that a signal ended has 128 + the signal.
struct ProgramRun {
  int exit_code = -1;
  std::string out;
  std::string err;
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

// Path of the telestrain of this build.
std::filesystem::path TelestrainPath();

// The committed session of data/.
std::filesystem::path SmallSession();

// The bytes of every file below `folder`, by its path inside.
std::map<std::string, std::string> BytesBelow(const std::filesystem::path& folder);

std::string ReadAll(const std::filesystem::path& path);

}  // namespace telestrain::testing_support
