#include "robustness/fault_subject.h"

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "cli/program_run.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

std::string InWords(const std::vector<std::string>& names) {
  std::string words;
  for (const std::string& name : names) words += (words.empty() ? "" : ", ") + name;
  return words;
}

void MustRun(const std::vector<std::string>& words, const Surroundings& where = {}) {
  const ProgramRun run = RunTelestrain(words, where);
  if (run.exit_code != 0) throw std::runtime_error("an undisturbed run failed: " + run.err);
}

}  // namespace

FaultSubject::FaultSubject(const fs::path& work, bool over_older)
    : work_(work), older_(over_older ? work / "older" : fs::path()) {
  fs::create_directories(work);
  if (over_older) {
    MustRun({"run", SmallSession().string(), "--out", older_.string(), "--outliers", "mrcal",
             "--subset-px", "41"});
    before_ = BytesBelow(older_);
  }
  Reset();
  const auto start = std::chrono::steady_clock::now();
  MustRun(words(), {".", ShimEnvironment(results(), {0, 0, false, work_ / "calls"})});
  took_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::ifstream(work_ / "calls") >> calls_;
  undisturbed_ = BytesBelow(results());
  if (const auto broken = BrokenFiles(results()); !broken.empty() || calls_ == 0)
    throw std::runtime_error("an undisturbed run left broken files: " + InWords(broken));
}

FaultSubject::FaultSubject(const fs::path& work, const fs::path& before,
                           const fs::path& undisturbed)
    : work_(work),
      older_(before),
      before_(BytesBelow(before)),
      undisturbed_(BytesBelow(undisturbed)) {
  fs::create_directories(work);
}

void FaultSubject::Reset() const {
  fs::remove_all(results());
  if (!older_.empty()) fs::copy(older_, results(), fs::copy_options::recursive);
}

std::vector<std::string> FaultSubject::words() const {
  return {"run", SmallSession().string(), "--out", results().string()};
}

std::string FaultSubject::AfterEnding(bool temporaries) const {
  const auto wrong = NeitherOldNorNew(results(), before_, undisturbed_, temporaries);
  return wrong.empty() ? "" : "neither old nor new: " + InWords(wrong);
}

std::string FaultSubject::AfterRepeating() const {
  const ProgramRun again = RunTelestrain(words());
  if (again.exit_code != 0) return "the repeated run fails: " + again.err;
  const FileBytes now = BytesBelow(results());
  std::vector<std::string> other;
  for (const auto& [name, bytes] : undisturbed_)
    if (const auto found = now.find(name); found == now.end() || found->second != bytes)
      other.push_back(name);
  for (const auto& [name, bytes] : now)
    if (!undisturbed_.contains(name)) other.push_back(name);
  return other.empty() ? "" : "after repeating, unlike an undisturbed run: " + InWords(other);
}

std::map<std::string, std::optional<std::string>> ShimEnvironment(const fs::path& folder,
                                                                  const ShimPlan& plan) {
  std::map<std::string, std::optional<std::string>> environment{
      {"LD_PRELOAD", TELESTRAIN_FAULT_SHIM},
      {"FAULT_FOLDER", folder.string()},
      {"FAULT_AT", std::to_string(plan.at)},
      {"FAULT_ERRNO", std::to_string(plan.error)},
      {"FAULT_STAYS", plan.stays ? "1" : "0"}};
  if (!plan.count.empty()) environment["FAULT_COUNT"] = plan.count.string();
  return environment;
}

}  // namespace telestrain::testing_support
