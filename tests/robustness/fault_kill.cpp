// Kills `telestrain run` at random moments; see kHelp.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <thread>

#include "cli/program_run.h"
#include "robustness/fault_arguments.h"
#include "robustness/fault_subject.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelp =
    "fault_kill [--moments N] [--older 0|1|2] [--seed S]\n"
    "Runs `telestrain run` on data/small_session N times (default 200) and kills it (SIGKILL), by\n"
    "turns at a random time and before a random one of the calls that write into the results.\n"
    "After each: every file must be the old or the new one, whole; the run, repeated, must end "
    "with\n"
    "the bytes of an undisturbed run. --older: 0 into an empty folder, 1 over the results of a "
    "run\n"
    "with other options, 2 (default) both by turns. Exit code 0: no finding. Last line: the "
    "figures.\n";

// What killed runs were at: the last step in the trail.
std::string LastStep(const fs::path& results) {
  std::ifstream trail(results / "audit.jsonl");
  std::string last = "open";
  for (std::string line; std::getline(trail, line);) {
    const std::size_t at = line.find("\"type\":\"") + 8;
    last = line.substr(at, line.find('"', at) - at);
  }
  return "after " + last;
}

struct Figures {
  int moments = 0, by_call = 0, findings = 0, with_temporary = 0, too_late = 0;
  std::map<std::string, int> steps;
};

// Whether the program was killed, not ended before.
bool Kill(const FaultSubject& subject, bool by_call, std::mt19937& random) {
  if (by_call) {
    const long at = 1 + static_cast<long>(random() % static_cast<unsigned long>(subject.calls()));
    return RunTelestrain(subject.words(), {".", ShimEnvironment(subject.results(), {at})})
               .exit_code == 128 + SIGKILL;
  }
  RunningTelestrain program(subject.words());
  const double when_s = subject.took_s() * static_cast<double>(random() % 10000) / 10000;
  std::this_thread::sleep_for(std::chrono::duration<double>(when_s));
  program.Signal(SIGKILL);
  return program.Wait().exit_code == 128 + SIGKILL;
}

void OneMoment(const FaultSubject& subject, bool by_call, std::mt19937& random, Figures& figures) {
  subject.Reset();
  while (!Kill(subject, by_call, random)) {
    ++figures.too_late;
    subject.Reset();
  }
  ++figures.moments;
  figures.by_call += by_call;
  figures.with_temporary += !TemporariesIn(subject.results()).empty();
  const std::string step = LastStep(subject.results());
  ++figures.steps[step];
  for (const std::string& finding : {subject.AfterEnding(true), subject.AfterRepeating()})
    if (!finding.empty()) {
      ++figures.findings;
      std::cout << "FINDING at moment " << figures.moments << " (" << step << "): " << finding
                << std::endl;
    }
}

int Main(int argc, char** argv) {
  const auto numbers = NumbersOf(argc, argv, {{"moments", 200}, {"older", 2}, {"seed", 1}}, kHelp);
  std::string name = (fs::temp_directory_path() / "telestrain_fault_kill_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  const fs::path work = name;
  std::vector<FaultSubject> subjects;
  if (numbers.at("older") != 1) subjects.emplace_back(work / "empty", false);
  if (numbers.at("older") != 0) subjects.emplace_back(work / "over", true);
  std::mt19937 random(static_cast<unsigned>(numbers.at("seed")));
  Figures figures;
  for (long i = 0; i < numbers.at("moments"); ++i) {
    OneMoment(subjects[static_cast<std::size_t>(i) % subjects.size()], i / 2 % 2 == 1, random,
              figures);
    if (i % 20 == 19) std::cout << i + 1 << " moments" << std::endl;
  }
  fs::remove_all(work);
  for (const auto& [step, count] : figures.steps) std::cout << step << ": " << count << '\n';
  std::cout << figures.moments << " moments (" << figures.by_call << " at a call), "
            << figures.with_temporary << " left a temporary, " << figures.too_late
            << " ended before the kill and were drawn again: " << figures.findings << " findings\n";
  return figures.findings == 0 ? 0 : 1;
}

}  // namespace
}  // namespace telestrain::testing_support

int main(int argc, char** argv) { return telestrain::testing_support::Main(argc, argv); }
