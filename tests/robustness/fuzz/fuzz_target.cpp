#include "robustness/fuzz/fuzz_target.h"

#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace telestrain::fuzz {

namespace fs = std::filesystem;

void Require(bool holds, const std::string& law) {
  if (!holds) throw std::logic_error("does not hold: " + law);
}

void RequireSaid(const Error& error) {
  Require(!error.message.empty(), "an error says something");
  Require(error.kind == ErrorKind::kUsage || error.kind == ErrorKind::kBadInput ||
              error.kind == ErrorKind::kEstimationFailed || error.kind == ErrorKind::kOutputFailed,
          "an error has one of the documented kinds");
}

std::map<std::string, std::string> FilesIn(std::string_view input,
                                           const std::set<std::string>& names) {
  std::map<std::string, std::string> files;
  std::string* file = nullptr;
  while (!input.empty()) {
    const std::size_t end = std::min(input.find('\n'), input.size() - 1) + 1;
    std::string_view line = input.substr(0, end);
    input.remove_prefix(end);
    if (line.starts_with(kFileMark)) {
      std::string name(line.substr(kFileMark.size()));
      while (!name.empty() && name.back() == '\n') name.pop_back();
      file = names.contains(name) ? &files[name] : nullptr;
    } else if (file) {
      file->append(line);
    }
  }
  return files;
}

MemoryFolder::MemoryFolder(const std::string& name) {
  std::error_code code;
  const fs::path memory = "/dev/shm";
  path_ = (fs::is_directory(memory, code) ? memory : fs::temp_directory_path()) /
          ("telestrain_fuzz_" + name + std::to_string(::getpid()));
  fs::create_directories(path_);
}

MemoryFolder::~MemoryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void MemoryFolder::Hold(const std::map<std::string, std::string>& files,
                        const std::set<std::string>& names) {
  for (const std::string& name : names) {
    const auto at = files.find(name);
    if (at == files.end()) {
      std::error_code ignored;
      fs::remove(path_ / name, ignored);
      continue;
    }
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << at->second;
  }
}

}  // namespace telestrain::fuzz
