#include "robustness/bad_input/damaged_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/utf8.h"

namespace telestrain::testing_support {

namespace fs = std::filesystem;

std::string FaultOfMessage(const std::string& message, const std::string& file) {
  if (message.find(file) == std::string::npos) return "does not name " + file;
  if (message.find(';') == std::string::npos) return "names no remedy";
  return "";
}

namespace {

// Names only: a message with the bytes would take gigabytes.
std::vector<std::string> Differing(const std::map<std::string, std::string>& found,
                                   const std::map<std::string, std::string>& expected) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : expected) {
    const auto at = found.find(name);
    if (at == found.end() || at->second != bytes) names.push_back(name);
  }
  for (const auto& [name, bytes] : found)
    if (!expected.contains(name)) names.push_back("new: " + name);
  return names;
}

}  // namespace

DamagedFolder::DamagedFolder(fs::path folder)
    : folder_(std::move(folder)), before_(BytesBelow(folder_)) {}

void DamagedFolder::Write(const std::string& file, const std::string& bytes) const {
  std::ofstream(folder_ / file, std::ios::binary) << bytes;
}

void DamagedFolder::PutBack() {
  for (const auto& [file, bytes] : BytesBelow(folder_)) {
    const auto known = before_.find(file);
    if (known == before_.end())
      fs::remove(folder_ / file);
    else if (known->second != bytes)
      Write(file, known->second);
  }
  for (const auto& [file, bytes] : before_)
    if (!fs::exists(folder_ / file)) Write(file, bytes);
}

int DamagedFolder::ExpectRefusedOrTaken(const std::string& file,
                                        const std::vector<Damaged>& damages, const Reader& read) {
  int refusals = 0;
  for (const Damaged& damage : damages) {
    SCOPED_TRACE(file + ": " + damage.what);
    Write(file, damage.bytes);
    std::optional<Error> error;
    ::testing::internal::CaptureStderr();
    try {
      error = read();
    } catch (const std::exception& e) {
      ADD_FAILURE() << "a defect: " << e.what();
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    if (error) {
      ++refusals;
      EXPECT_TRUE(error->kind == ErrorKind::kBadInput ||
                  error->kind == ErrorKind::kEstimationFailed);
      const bool is_bad = error->kind == ErrorKind::kBadInput;
      EXPECT_EQ(FaultOfMessage(error->message, is_bad ? fs::path(file).filename() : ""), "")
          << PrintableText(error->message);
      auto expected = before_;
      expected[file] = damage.bytes;
      EXPECT_EQ(Differing(BytesBelow(folder_), expected), std::vector<std::string>());
    }
    PutBack();
  }
  return refusals;
}

}  // namespace telestrain::testing_support
