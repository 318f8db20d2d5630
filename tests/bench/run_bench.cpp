#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

// run_bench FOLDER [OPTION…]
// `telestrain run` on a session of 24 + 12 + 6 full-size images against OpenCV's decoding of the
// same files on one thread, and where the time goes. FOLDER keeps the session, which the program
// itself makes unless it is there; the options (such as --threads 1) are passed to `run`. Exits
// with 1 when the run takes more than 8 times the decoding or more than 1 GiB.

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kMostDecodings = 8, kMost_mib = 1024;
// The first words of the lines that end the steps.
const std::vector<std::string> kSteps{"detect",  "calibrate", "diagnose", "verify",
                                      "measure", "render",    "report"};

struct Times {
  double seconds = 0, processor_s = 0;
};

struct Step {
  std::string name;
  Times end;  // since the start of the program
};

struct Cost {
  int exit_code = -1;  // -1: could not be started, or was ended by a signal
  Times total;
  double peak_mib = 0;
  std::vector<Step> steps;
};

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double SecondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double OwnProcessor_s() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return SecondsOf(used.ru_utime) + SecondsOf(used.ru_stime);
}

// Of a running child: fields 14 and 15 of its stat, of which the second is the name in brackets.
double ProcessorOf_s(pid_t child) {
  std::ifstream file("/proc/" + std::to_string(child) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t name_end = text.rfind(')');
  long user = 0, system = 0;
  if (name_end == std::string::npos ||
      std::sscanf(text.c_str() + name_end + 1,
                  " %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %ld %ld", &user, &system) != 2)
    return 0;
  return static_cast<double>(user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// Becomes telestrain with these words, which writes what it says into the pipe.
[[noreturn]] void Become(std::vector<std::string> words, int pipe) {
  words.insert(words.begin(), TELESTRAIN_PROGRAM);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  dup2(pipe, STDOUT_FILENO);
  execv(arguments.front(), arguments.data());
  _exit(127);
}

// Notes when the child says that a step ended, until it says no more.
std::vector<Step> FollowSteps(int pipe, pid_t child, Clock::time_point start) {
  std::vector<Step> steps;
  FILE* const said = fdopen(pipe, "r");
  char line[4096];
  while (said && std::fgets(line, sizeof line, said)) {
    const std::string word(line, std::strcspn(line, " \n"));
    if (std::find(kSteps.begin(), kSteps.end(), word) != kSteps.end())
      steps.push_back({word, {SecondsSince(start), ProcessorOf_s(child)}});
  }
  if (said) std::fclose(said);
  return steps;
}

Cost RunProgram(const std::vector<std::string>& words) {
  Cost cost;
  int ends[2];
  if (pipe(ends) != 0) return cost;
  const auto start = Clock::now();
  const pid_t child = fork();
  if (child == 0) Become(words, ends[1]);
  close(ends[1]);
  if (child < 0) return cost;
  cost.steps = FollowSteps(ends[0], child, start);
  int status = 0;
  rusage used{};
  if (wait4(child, &status, 0, &used) != child || !WIFEXITED(status)) return cost;
  cost.exit_code = WEXITSTATUS(status);
  cost.total = {SecondsSince(start), SecondsOf(used.ru_utime) + SecondsOf(used.ru_stime)};
  cost.peak_mib = static_cast<double>(used.ru_maxrss) / 1024;
  return cost;
}

std::vector<fs::path> ImagesBelow(const fs::path& folder) {
  std::vector<fs::path> images;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".png") images.push_back(entry.path());
  std::sort(images.begin(), images.end());
  return images;
}

// OpenCV's decoding of all files on one thread, once more than measured so that the files are in
// memory for both; the faster of two.
Times Decode(const std::vector<fs::path>& images) {
  cv::setNumThreads(1);
  Times best;
  for (int round = 0; round < 3; ++round) {
    const auto start = Clock::now();
    const double before_s = OwnProcessor_s();
    for (const fs::path& image : images)
      if (cv::imread(image.string(), cv::IMREAD_UNCHANGED).empty())
        throw std::runtime_error(image.string() + ": cannot be decoded");
    const Times now{SecondsSince(start), OwnProcessor_s() - before_s};
    if (round == 1 || (round > 1 && now.seconds < best.seconds)) best = now;
  }
  return best;
}

void PrintProfile(const Cost& cost) {
  std::printf("%-10s %8s %6s %12s %6s\n", "step", "s", "share", "processor s", "cores");
  Times before;
  const auto row = [&](const std::string& name, const Times& end) {
    const double seconds = end.seconds - before.seconds,
                 processor_s = end.processor_s - before.processor_s;
    std::printf("%-10s %8.2f %5.1f%% %12.2f %6.2f\n", name.c_str(), seconds,
                100 * seconds / cost.total.seconds, processor_s, processor_s / seconds);
    before = end;
  };
  for (const Step& step : cost.steps) row(step.name, step.end);
  row("end", cost.total);
  before = {};
  row("all", cost.total);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: run_bench FOLDER [OPTION of telestrain run…]\n";
    return 2;
  }
  const fs::path folder = argv[1], session = folder / "session", results = folder / "results";
  if (!fs::exists(session) && RunProgram({"simulate", "--out", session.string()}).exit_code != 0) {
    std::cerr << "run_bench: no session in " << session << '\n';
    return 1;
  }
  const std::vector<fs::path> images = ImagesBelow(session);
  const Times decoding = Decode(images);
  fs::remove_all(results);
  std::vector<std::string> words{"run", session.string(), "--out", results.string()};
  words.insert(words.end(), argv + 2, argv + argc);
  const Cost cost = RunProgram(words);
  // 1: a limit of acceptance is missed, which does not matter here.
  if ((cost.exit_code != 0 && cost.exit_code != 1) || cost.steps.size() != kSteps.size()) {
    std::cerr << "run_bench: telestrain run exits with " << cost.exit_code << '\n';
    return 1;
  }
  PrintProfile(cost);
  const double ratio = cost.total.seconds / decoding.seconds;
  std::printf("OpenCV decodes the %zu images in %.2f s (%.2f s of a processor) on one thread\n",
              images.size(), decoding.seconds, decoding.processor_s);
  std::printf("ratio %.2f, bar %.0f (of processor time %.2f); peak memory %.0f MiB, bar %.0f MiB\n",
              ratio, kMostDecodings, cost.total.processor_s / decoding.processor_s, cost.peak_mib,
              kMost_mib);
  return ratio <= kMostDecodings && cost.peak_mib <= kMost_mib ? 0 : 1;
}
