// Lets single writes of `telestrain run` fail; see kHelp.
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <iostream>

#include "cli/program_run.h"
#include "robustness/fault_arguments.h"
#include "robustness/fault_subject.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelp =
    "fault_writes [--calls N] [--older 0|1]\n"
    "Runs `telestrain run` on data/small_session N times (default: once for each of its calls "
    "that\n"
    "write into the results) and lets one call after another fail, spread over all: by turns with\n"
    "ENOSPC, EIO, EROFS and EDQUOT, by turns for once and from then on. Each run must end with 5 "
    "and\n"
    "name the path, the system's reason and a remedy, leave every file old or new and no "
    "temporary;\n"
    "repeated, it must end with the bytes of an undisturbed run. --older 1: over older results.\n"
    "Exit code 0: no finding. Last line: the figures.\n";

constexpr std::array kErrors = {ENOSPC, EIO, EROFS, EDQUOT};

// The line that tells of the failure.
std::string FindingIn(const ProgramRun& run, const FaultSubject& subject, int error) {
  if (run.exit_code != 5)
    return "ends with " + std::to_string(run.exit_code) + " in place of 5: " + run.err;
  for (const std::string& part :
       {subject.results().string(), std::string(std::strerror(error)), std::string("; ")})
    if (run.err.find(part) == std::string::npos)
      return "the message lacks '" + part + "': " + run.err;
  return "";
}

int Main(int argc, char** argv) {
  const auto numbers = NumbersOf(argc, argv, {{"calls", 0}, {"older", 0}}, kHelp);
  std::string name = (fs::temp_directory_path() / "telestrain_fault_writes_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  const FaultSubject subject(name, numbers.at("older") == 1);
  const long all = subject.calls();
  const long count = numbers.at("calls") > 0 ? std::min(numbers.at("calls"), all) : all;
  int findings = 0;
  for (long i = 0; i < count; ++i) {
    const long at = 1 + (count == 1 ? 0 : i * (all - 1) / (count - 1));
    const int error = kErrors[static_cast<std::size_t>(i) % kErrors.size()];
    const bool stays = i / 4 % 2 == 1;
    subject.Reset();
    const ProgramRun run = RunTelestrain(
        subject.words(), {".", ShimEnvironment(subject.results(), {at, error, stays})});
    for (const std::string& finding :
         {FindingIn(run, subject, error), subject.AfterEnding(false), subject.AfterRepeating()})
      if (!finding.empty()) {
        ++findings;
        std::cout << "FINDING at call " << at << (stays ? " and later" : "") << " ("
                  << std::strerror(error) << "): " << finding << std::endl;
      }
  }
  fs::remove_all(name);
  std::cout << count << " of " << all << " calls failed in turn: " << findings << " findings\n";
  return findings == 0 ? 0 : 1;
}

}  // namespace
}  // namespace telestrain::testing_support

int main(int argc, char** argv) { return telestrain::testing_support::Main(argc, argv); }
