#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "robustness/fault_folder.h"

namespace telestrain::testing_support {

// A `telestrain run` that is to be disturbed: of the small session, into an empty folder or over
// the results of a run with other options, with what it ends with when nothing disturbs it.
class FaultSubject {
 public:
  // Runs it undisturbed. `work`: a folder for everything; `over_older`: over the results that the
  // same session gave with other options. Throws std::runtime_error when that fails or a file of
  // the outcome is not whole.
  FaultSubject(const std::filesystem::path& work, bool over_older);

  // Of results that lie there already: where the run begins, and what it ends with.
  FaultSubject(const std::filesystem::path& work, const std::filesystem::path& before,
               const std::filesystem::path& undisturbed);

  // Puts the results folder back to where the run begins.
  void Reset() const;
  std::filesystem::path results() const { return work_ / "results"; }
  std::vector<std::string> words() const;  // of the run, without the program
  double took_s() const { return took_s_; }
  long calls() const { return calls_; }  // that the shim counts

  // What is wrong after the run was ended part-way, in words; empty: nothing.
  std::string AfterEnding(bool temporaries) const;
  // Repeats the run, undisturbed; the same.
  std::string AfterRepeating() const;

 private:
  std::filesystem::path work_, older_;
  FileBytes before_, undisturbed_;
  double took_s_ = 0;
  long calls_ = 0;
};

// The environment that lets the shim act on writes below `folder`.
struct ShimPlan {
  long at = 0;
  int error = 0;
  bool stays = false;
  std::filesystem::path count = {};
};
std::map<std::string, std::optional<std::string>> ShimEnvironment(
    const std::filesystem::path& folder, const ShimPlan& plan);

}  // namespace telestrain::testing_support
