#include "study/study.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/files.h"
#include "base/numbers.h"

namespace telestrain {
namespace {

constexpr std::array kStudies{
    StudyInfo{"paper-simulation",
              "72 board and 16 ruler images, telecentric against pinhole (section 3, Fig. 7 and 8)",
              StudyPaperSimulation},
    StudyInfo{"paper-calibration",
              "corners of 1200 board and 850 ruler images, the U shape (section 4, Fig. 12 to 14)",
              StudyPaperCalibration},
    StudyInfo{"paper-strain",
              "eight load cycles 0 to 750 µε against four gauges (section 4.3, Fig. 16)",
              StudyPaperStrain},
    StudyInfo{"sensitivity", "error of ruler and strain against each source of error",
              StudySensitivity},
    StudyInfo{"convergence", "figures against the number of poses, the tilt range and the noise",
              StudyConvergence},
};

constexpr double kLeastShare = 0.02;
constexpr int kMostBinning = 4, kMostThreads = 1024;

Error OutOfRange(const std::string& name, const std::string& found, const std::string& limit) {
  return {ErrorKind::kUsage,
          "--" + name + " is " + found + ", wanted " + limit + "; choose a value inside"};
}

Status CheckOptions(const StudyOptions& options) {
  if (!(options.share >= kLeastShare && options.share <= 1))
    return OutOfRange("share", FormatShortest(options.share),
                      FormatShortest(kLeastShare) + " to 1");
  if (options.binning < 1 || options.binning > kMostBinning)
    return OutOfRange("binning", std::to_string(options.binning),
                      "1 to " + std::to_string(kMostBinning));
  if (options.threads < 0 || options.threads > kMostThreads)
    return OutOfRange("threads", std::to_string(options.threads),
                      "0 to " + std::to_string(kMostThreads));
  return {};
}

Result<const StudyInfo*> FindStudy(const std::string& name) {
  std::vector<std::string> names;
  for (const StudyInfo& info : kStudies) {
    if (name == info.name) return &info;
    names.emplace_back(info.name);
  }
  return Error{ErrorKind::kUsage,
               "unknown study '" + name + "'; the nearest is '" + NearestWord(name, names) + "'"};
}

}  // namespace

int StudyOptions::Scaled(int full, int least) const {
  return std::max(least, static_cast<int>(std::lround(full * share)));
}

std::span<const StudyInfo> AllStudies() { return kStudies; }

Result<StudyResult> RunStudy(const std::string& name, const StudyOptions& options,
                             const std::filesystem::path& folder, Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(CheckOptions(options));
  TELESTRAIN_ASSIGN_OR_RETURN(const StudyInfo* info, FindStudy(name));
  // A folder that cannot be made is known before minutes are spent.
  TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder));
  TELESTRAIN_ASSIGN_OR_RETURN(StudyResult result, info->run(options, folder, console));
  result.settings.push_back({"seed", std::to_string(options.seed), ""});
  result.settings.push_back({"share of the full size", FormatShortest(options.share), ""});
  result.settings.push_back({"pixels binned along a side", std::to_string(options.binning), ""});
  if (options.share < 1)
    result.notes.insert(
        result.notes.begin(),
        "A quick look with " + FormatShortest(100 * options.share) + " % of the full size.");
  return result;
}

}  // namespace telestrain
