#include "cli/session_copy.h"

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "cli/kept_run.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

void WriteAll(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

SessionCopy::SessionCopy() : scratch_("telestrain_cli_") {
  session_ = scratch() / "session";
  results_ = scratch() / "results";
  fs::copy(SmallSession(), session_, fs::copy_options::recursive);
}

void SessionCopy::Replace(const std::string& file, const std::string& from, const std::string& to) {
  std::string text = ReadAll(session_ / file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << file << " lacks " << from;
  ASSERT_EQ(text.find(from, at + 1), std::string::npos) << from << " stands twice in " << file;
  WriteAll(session_ / file, text.replace(at, from.size(), to));
}

void SessionCopy::KeepLines(const std::string& file, int count) {
  const std::string text = ReadAll(session_ / file);
  std::size_t end = 0;
  for (int line = 0; line < count; ++line) end = text.find('\n', end) + 1;
  WriteAll(session_ / file, text.substr(0, end));
}

void SessionCopy::KeepBytes(const std::string& file, long count) {
  fs::resize_file(session_ / file, static_cast<std::uintmax_t>(count));
}

void SessionCopy::Remove(const std::string& file) { ASSERT_TRUE(fs::remove(session_ / file)); }

void SessionCopy::MakeBlank(const std::string& file, int width_px, int height_px) {
  const cv::Mat gray(height_px, width_px, CV_8U, cv::Scalar(90));
  ASSERT_TRUE(cv::imwrite((session_ / file).string(), gray));
}

ProgramRun SessionCopy::Run(const std::string& verb) const {
  return RunTelestrain({verb, session_.string(), "--out", results_.string()});
}

void SessionCopy::MustRun(std::initializer_list<std::string> verbs) const {
  for (const std::string& verb : verbs) {
    const ProgramRun run = Run(verb);
    ASSERT_EQ(run.exit_code, 0) << verb << ": " << run.err;
  }
}

void SessionCopy::TakeRun(const std::vector<std::string>& verbs) const {
  const KeptRun kept = KeptRunOf(verbs);
  ASSERT_EQ(kept.run.exit_code, 0) << kept.run.err;
  ASSERT_FALSE(fs::exists(results_));
  fs::copy(kept.folder / "results", results_, fs::copy_options::recursive);
  WriteAll(results_ / "session.path", session_.string() + "\n");
}

void SessionCopy::ExpectBadInput(std::initializer_list<std::string> parts) const {
  const ProgramRun run = Run("run");
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_EQ(run.out, "");
  for (const std::string& part : parts)
    EXPECT_NE(run.err.find(part), std::string::npos) << "wanted: " << part << "\nis: " << run.err;
  EXPECT_FALSE(fs::exists(results_));
}

}  // namespace telestrain::testing_support
