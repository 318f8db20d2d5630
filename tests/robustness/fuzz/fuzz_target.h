#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace telestrain::fuzz {

// A target gives any bytes to the parsers of one kind of file and checks what must hold for all
// bytes. It throws or crashes where a parser has a fault. The build with libFuzzer (preset fuzz)
// makes a program of each; the ordinary tests replay the kept corpus through them.
using Target = void (*)(std::string_view input);

void FuzzText(std::string_view input);         // tables, numbers, TOML, times, {{…}}, lists
void FuzzSession(std::string_view input);      // session.toml and its three tables
void FuzzCorners(std::string_view input);      // corners.vnl and what lies beside it
void FuzzCalibration(std::string_view input);  // calibration.json, residuals, states, inputs.json
void FuzzResults(std::string_view input);      // all results JSON -> results.json and dcc.xml
void FuzzReport(std::string_view input);       // layouts, texts, results.json -> report.pdf
void FuzzPdf(std::string_view input);          // report.pdf: structure, text, signatures
void FuzzSignature(std::string_view input);    // DER, CMS, time stamps, certificates, keys
void FuzzAudit(std::string_view input);        // audit.jsonl and the checks of what it says
void FuzzImage(std::string_view input);        // headers and pixels of images

// Throws std::logic_error with the law that does not hold.
void Require(bool holds, const std::string& law);

// A failure is of a documented kind and says something.
void RequireSaid(const Error& error);

template <typename T>
bool Succeeds(const Result<T>& result) {
  if (!result.ok()) RequireSaid(result.error());
  return result.ok();
}

// An input of several files: a line "%%% NAME" begins one. Those that `names` does not hold are
// left out; the text before the first such line is dropped.
std::map<std::string, std::string> FilesIn(std::string_view input,
                                           const std::set<std::string>& names);
inline constexpr std::string_view kFileMark = "%%% ";

// A folder in memory (/dev/shm where it is there) that goes with the program.
class MemoryFolder {
 public:
  explicit MemoryFolder(const std::string& name);
  ~MemoryFolder();
  MemoryFolder(const MemoryFolder&) = delete;
  MemoryFolder& operator=(const MemoryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // Of `names` just those in `files` lie in the folder afterwards.
  void Hold(const std::map<std::string, std::string>& files, const std::set<std::string>& names);

 private:
  std::filesystem::path path_;
};

}  // namespace telestrain::fuzz
