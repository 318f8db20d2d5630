#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/program_run.h"
#include "unit/base/scratch_folder.h"

namespace telestrain::testing_support {

// A test with a copy of the small session that it may damage, and a results folder not yet made.
class SessionCopy : public ::testing::Test {
 protected:
  SessionCopy();

  const std::filesystem::path& session() const { return session_; }
  const std::filesystem::path& results() const { return results_; }
  const std::filesystem::path& scratch() const { return scratch_.path(); }

  // Replaces the only occurrence of `from` in a file of the session; fails the test if there is
  // none or more than one.
  void Replace(const std::string& file, const std::string& from, const std::string& to);
  void KeepLines(const std::string& file, int count);   // the first ones
  void KeepBytes(const std::string& file, long count);  // the first ones
  void Remove(const std::string& file);
  // Overwrites an image by one of a single grey level; the sensor has 648 x 486 px.
  void MakeBlank(const std::string& file, int width_px = 648, int height_px = 486);

  // `verb SESSION --out RESULTS`.
  ProgramRun Run(const std::string& verb) const;
  // Runs the verbs in turn; each must end with 0.
  void MustRun(std::initializer_list<std::string> verbs) const;
  // The results of the verbs from the small session, copied from those kept for all tests; only for
  // a session that was not changed yet and a results folder that is not there.
  void TakeRun(const std::vector<std::string>& verbs) const;
  // Expects exit code 3, every one of `parts` in the message and nothing in the results folder.
  void ExpectBadInput(std::initializer_list<std::string> parts) const;

 private:
  ScratchFolder scratch_;
  std::filesystem::path session_, results_;
};

}  // namespace telestrain::testing_support
