#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "robustness/fuzz/fuzz_target.h"

namespace telestrain::fuzz {

// Inputs to begin with: files that every parser accepts, a folder per target.
class Seeds {
 public:
  explicit Seeds(std::filesystem::path root) : root_(std::move(root)) {}
  void Write(const std::string& target, const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories(root_ / target);
    std::ofstream(root_ / target / name, std::ios::binary) << bytes;
  }

 private:
  std::filesystem::path root_;
};

// One input of several files (FilesIn).
inline std::string Joined(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string text;
  for (const auto& [name, bytes] : files) {
    text += std::string(kFileMark) + name + "\n" + bytes;
    if (!bytes.ends_with('\n')) text += '\n';
  }
  return text;
}

std::string FileText(const std::filesystem::path& path);
std::string FirstLines(const std::string& text, int count);
// As one line; long lists keep their beginning, for what reads them does the same with every entry.
std::string Short(nlohmann::ordered_json json);

void WriteResultsSeeds(const Seeds& seeds);    // results, calibration, report
void WriteSignatureSeeds(const Seeds& seeds);  // pdf, signature, audit

}  // namespace telestrain::fuzz
