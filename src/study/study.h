#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/console.h"
#include "base/result.h"
#include "study/study_result.h"

namespace telestrain {

// How large a study is and what its randomness follows from.
struct StudyOptions {
  std::uint64_t seed = 1;
  // Share of the full number of images, poses, rulers and load states. 1 is the paper's own
  // number; less is for a quick look, and the result says so.
  double share = 1.0;
  // Pixels binned along each side in the studies that render images: 1 is the paper's sensor.
  int binning = 1;
  int threads = 0;  // 0: one per core; the results do not depend on it

  // `full` times the share, rounded, but at least `least`.
  int Scaled(int full, int least) const;
};

// One reproducible numerical experiment.
struct StudyInfo {
  const char* name;
  const char* summary;  // one line
  Result<StudyResult> (*run)(const StudyOptions& options, const std::filesystem::path& folder,
                             Console& console);
};
std::span<const StudyInfo> AllStudies();

// Runs the study of this name; its result names the options. Fails (kUsage) when there is none of
// this name, naming the nearest one, or when an option is outside its range (share 0.02 to 1,
// binning 1 to 4, threads 0 to 1024); else like the study.
Result<StudyResult> RunStudy(const std::string& name, const StudyOptions& options,
                             const std::filesystem::path& folder, Console& console);

// The studies. Each writes the sessions that it renders below `folder`; the same options give the
// same result. Fail like the steps of the chain that they run.
Result<StudyResult> StudyPaperSimulation(const StudyOptions& options,
                                         const std::filesystem::path& folder, Console& console);
Result<StudyResult> StudyPaperCalibration(const StudyOptions& options,
                                          const std::filesystem::path& folder, Console& console);
Result<StudyResult> StudyPaperStrain(const StudyOptions& options,
                                     const std::filesystem::path& folder, Console& console);
Result<StudyResult> StudySensitivity(const StudyOptions& options,
                                     const std::filesystem::path& folder, Console& console);
Result<StudyResult> StudyConvergence(const StudyOptions& options,
                                     const std::filesystem::path& folder, Console& console);

}  // namespace telestrain
