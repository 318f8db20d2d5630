#include "robustness/fault_folder.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "base/files.h"
#include "cli/program_run.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool IsTable(const std::string& bytes) {
  const auto lines = LinesOf(bytes);
  const auto fields = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  return bytes.ends_with('\n') && std::all_of(lines.begin(), lines.end(), [&](const auto& line) {
           return fields(line) == fields(lines.front());
         });
}

bool IsJsonLines(const std::string& bytes) {
  const auto lines = LinesOf(bytes);
  return bytes.ends_with('\n') && std::all_of(lines.begin(), lines.end(), [](const auto& line) {
           return nlohmann::json::accept(line);
         });
}

bool IsPicture(const std::string& bytes) {
  const std::vector<unsigned char> data(bytes.begin(), bytes.end());
  return bytes.substr(0, bytes.size() - 4).ends_with("IEND") &&
         !cv::imdecode(data, cv::IMREAD_UNCHANGED).empty();
}

bool IsWhole(const fs::path& path, const std::string& bytes) {
  const std::string kind = path.extension().string();
  if (kind == ".json") return nlohmann::json::accept(bytes);
  if (kind == ".jsonl") return IsJsonLines(bytes);
  if (kind == ".csv") return IsTable(bytes);
  if (kind == ".png") return IsPicture(bytes);
  if (kind == ".vtp") return bytes.ends_with("</VTKFile>\n");
  if (kind == ".xml") return bytes.ends_with("</dcc:digitalCalibrationCertificate>\n");
  if (kind == ".pdf")
    return RunProgram({TELESTRAIN_QPDF_PROGRAM, "--check", path.string()}).exit_code == 0;
  return bytes.ends_with('\n');
}

bool Grows(const std::string& name) { return name.ends_with(".jsonl") || name == "strain.csv"; }

// `bytes` is a beginning of `whole` in whole lines.
bool IsBeginning(const std::string& bytes, const std::string& whole) {
  return whole.starts_with(bytes) && (bytes.empty() || bytes.ends_with('\n'));
}

bool MayBe(const std::string& name, const std::string& bytes, const FileBytes& before,
           const FileBytes& undisturbed) {
  const auto old_one = before.find(name), new_one = undisturbed.find(name);
  if (old_one != before.end() && bytes == old_one->second) return true;
  if (new_one == undisturbed.end()) return false;
  return bytes == new_one->second || (Grows(name) && IsBeginning(bytes, new_one->second));
}

}  // namespace

std::vector<std::string> BrokenFiles(const fs::path& folder) {
  std::vector<std::string> broken;
  for (const auto& [name, bytes] : BytesBelow(folder))
    if (!IsTemporary(fs::path(name).filename().string()) && !IsWhole(folder / name, bytes))
      broken.push_back(name);
  return broken;
}

std::vector<std::string> TemporariesIn(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const auto& [name, bytes] : BytesBelow(folder))
    if (IsTemporary(fs::path(name).filename().string())) names.push_back(name);
  return names;
}

std::vector<std::string> NeitherOldNorNew(const fs::path& folder, const FileBytes& before,
                                          const FileBytes& undisturbed, bool temporaries) {
  std::vector<std::string> wrong;
  if (!fs::exists(folder)) return wrong;
  for (const auto& [name, bytes] : BytesBelow(folder)) {
    const bool is_temporary = IsTemporary(fs::path(name).filename().string());
    if (is_temporary ? !temporaries : !MayBe(name, bytes, before, undisturbed))
      wrong.push_back(name);
  }
  return wrong;
}

}  // namespace telestrain::testing_support
