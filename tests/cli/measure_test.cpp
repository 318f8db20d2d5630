// `measure` state by state: what a killed run leaves and the next one makes of it, images that
// arrive while it runs, memory.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

int LinesIn(const fs::path& path) {
  std::ifstream file(path);
  int lines = 0;
  for (std::string line; std::getline(file, line);) ++lines;
  return lines;
}

int LinesOfText(const std::string& text, const std::string& part) {
  std::istringstream stream(text);
  int lines = 0;
  for (std::string line; std::getline(stream, line);) lines += Holds(line, part);
  return lines;
}

// A session whose pipe went through the small session's three states again and again.
class Measure : public SessionCopy {
 protected:
  void MakeStates(int count) {
    std::ofstream table(session() / "pipe.csv");
    table << "image,cycle,step";
    for (int gauge = 1; gauge <= 4; ++gauge) table << ",gauge_" << gauge << "_microstrain";
    table << '\n';
    for (int i = 0; i < count; ++i) {
      const std::string name = "pipe/state_" + std::to_string(100 + i) + ".png";
      fs::copy_file(session() / ("pipe/pipe_00" + std::to_string(i % 3) + ".png"),
                    session() / name);
      const std::string reading = i % 3 == 1 ? ",745" : ",0";
      table << name << ",1," << i << reading << reading << reading << reading << '\n';
    }
  }
  std::vector<std::string> MeasureInto(const fs::path& out,
                                       const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"measure", session().string(), "--out", out.string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  void MustMeasure(const fs::path& out) const {
    const ProgramRun run = RunTelestrain(MeasureInto(out));
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  // A copy of the calibrated results without any pipe state.
  fs::path Calibrated(const std::string& name) {
    if (!fs::exists(results())) MustRun({"detect", "calibrate"});
    fs::copy(results(), scratch() / name, fs::copy_options::recursive);
    return scratch() / name;
  }
};

TEST_F(Measure, AStateThatIsWholeWhenTheRunIsKilledIsNotMeasuredAgain) {
  MakeStates(9);
  const fs::path whole = Calibrated("whole"), killed = Calibrated("killed");
  MustMeasure(whole);
  {
    RunningTelestrain program(MeasureInto(killed));
    while (LinesIn(killed / "strain_states.jsonl") < 2 && !program.HasEnded())
      std::this_thread::sleep_for(1ms);
    program.Signal(SIGKILL);
    ASSERT_EQ(program.Wait().exit_code, 128 + SIGKILL) << "all states were done before the kill";
  }
  ASSERT_FALSE(fs::exists(killed / "strain.json"));
  const auto written = fs::last_write_time(killed / "pipe_001.vtp");
  MustMeasure(killed);
  EXPECT_EQ(fs::last_write_time(killed / "pipe_001.vtp"), written);
  EXPECT_EQ(DifferingFiles(whole, killed), std::vector<std::string>());
}

TEST_F(Measure, KilledAtAnyMomentAndRunAgainEndsWithTheSameBytes) {
  MakeStates(6);
  const fs::path whole = Calibrated("whole");
  const auto start = std::chrono::steady_clock::now();
  MustMeasure(whole);
  const auto took = std::chrono::steady_clock::now() - start;
  std::mt19937 random(1);
  for (int round = 0; round < 2; ++round) {
    const fs::path killed = Calibrated("killed_" + std::to_string(round));
    for (int kill = 0; kill < 3; ++kill) {
      RunningTelestrain program(MeasureInto(killed));
      std::this_thread::sleep_for(took * (random() % 1000) / 1000);
      program.Signal(SIGKILL);
    }
    MustMeasure(killed);
    EXPECT_EQ(DifferingFiles(whole, killed), std::vector<std::string>());
  }
}

TEST_F(Measure, ALineThatWasCutShortIsMeasuredAgain) {
  MakeStates(3);
  const fs::path whole = Calibrated("whole"), cut = Calibrated("cut");
  MustMeasure(whole);
  MustMeasure(cut);
  fs::resize_file(cut / "strain_states.jsonl", fs::file_size(cut / "strain_states.jsonl") - 40);
  fs::resize_file(cut / "strain.csv", fs::file_size(cut / "strain.csv") - 4);
  std::ofstream(cut / "pipe_001.vtp.telestrain-part-99999999") << "half";
  MustMeasure(cut);
  EXPECT_EQ(DifferingFiles(whole, cut), std::vector<std::string>());
}

TEST_F(Measure, AStateOfOtherInputsIsMeasuredAgain) {
  MakeStates(3);
  const fs::path out = Calibrated("out"), fresh = Calibrated("fresh");
  MustMeasure(out);
  const std::string before = ReadAll(out / "strain.csv");
  ASSERT_EQ(RunTelestrain(MeasureInto(out, {"--subset-px", "41"})).exit_code, 0);
  EXPECT_NE(ReadAll(out / "strain.csv"), before);
  MustMeasure(out);
  MustMeasure(fresh);
  // The trail tells of all three measurements.
  EXPECT_EQ(DifferingFiles(fresh, out), std::vector<std::string>{"audit.jsonl"});
}

TEST_F(Measure, AFailureBeforeTheFirstStateTakesNothingAway) {
  MakeStates(3);
  const fs::path out = Calibrated("out"), kept = scratch() / "kept";
  MustMeasure(out);
  ASSERT_EQ(RunTelestrain({"report", out.string()}).exit_code, 1);  // no ruler was verified
  fs::copy(out, kept, fs::copy_options::recursive);
  const ProgramRun run = RunTelestrain(MeasureInto(out, {"--subset-px", "301"}));
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_EQ(DifferingFiles(kept, out), std::vector<std::string>());
}

TEST_F(Measure, ACopiedImageIsToldOf) {
  MakeStates(5);
  const std::string err = RunTelestrain(MeasureInto(Calibrated("out"))).err;
  EXPECT_TRUE(Holds(err, "pipe/state_100.png and pipe/state_103.png have the same bytes, and 1"))
      << err;
}

TEST_F(Measure, ADamagedSurfaceIsMadeAgain) {
  MakeStates(3);
  const fs::path whole = Calibrated("whole"), damaged = Calibrated("damaged");
  MustMeasure(whole);
  MustMeasure(damaged);
  fs::resize_file(damaged / "pipe_001.vtp", 1000);
  MustMeasure(damaged);
  EXPECT_EQ(DifferingFiles(whole, damaged), std::vector<std::string>());
}

// 27 more images are 34 MB, the points of 27 more states 1.5 MB.
TEST_F(Measure, MemoryDoesNotGrowWithTheStates) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps what was freed";
#endif
  MakeStates(30);
  const fs::path many = Calibrated("many");
  const ProgramRun thirty = RunTelestrain(MeasureInto(many));
  ASSERT_EQ(thirty.exit_code, 0) << thirty.err;
  const fs::path calibrated_with = results();
  fs::remove_all(calibrated_with);
  KeepLines("pipe.csv", 4);
  const fs::path few = Calibrated("few");
  const ProgramRun three = RunTelestrain(MeasureInto(few));
  ASSERT_EQ(three.exit_code, 0) << three.err;
  EXPECT_LT(thirty.peak_memory_kib - three.peak_memory_kib, 5 * 1024);
}

TEST_F(Measure, AnOptionOutsideItsRangeIsAnError) {
  for (const auto& [option, value] :
       {std::pair{"--subset-px", "40"}, {"--subset-px", "7"}, {"--step-px", "-1"}}) {
    const ProgramRun run = RunTelestrain(MeasureInto(results(), {option, value}));
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_TRUE(Holds(run.err, option)) << run.err;
  }
}

// The pipe's images come to a folder beside the session, which has none.
class Watch : public Measure {
 protected:
  Watch() {
    fs::rename(session() / "pipe", scratch() / "camera");
    fs::rename(session() / "pipe.csv", scratch() / "pipe.csv");
    fs::create_directory(arriving());
  }
  fs::path arriving() const { return scratch() / "arriving"; }
  void Arrive(int image) const {
    const std::string name = "pipe_00" + std::to_string(image) + ".png";
    fs::copy_file(scratch() / "camera" / name, arriving() / name);
  }
  std::vector<std::string> WatchInto(const fs::path& out,
                                     const std::vector<std::string>& more) const {
    auto arguments = MeasureInto(out, {"--watch", arriving().string()});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  // Until the file has so many lines, a minute at the most.
  static void AwaitLines(const fs::path& file, int lines) {
    for (int i = 0; i < 6000 && LinesIn(file) < lines; ++i) std::this_thread::sleep_for(10ms);
    ASSERT_GE(LinesIn(file), lines) << file;
  }
};

TEST_F(Watch, ImagesAreMeasuredAsTheyArriveAndABadOneIsLeftOut) {
  const fs::path out = Calibrated("out");
  RunningTelestrain program(WatchInto(out, {"--until", "3"}));
  Arrive(0);
  AwaitLines(out / "strain.csv", 2);
  std::ofstream(arriving() / "pipe_000_bad.png") << "no image";
  Arrive(1);
  AwaitLines(out / "strain.csv", 3);
  Arrive(2);
  const ProgramRun run = program.Wait();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(LinesOfText(run.out, " axial "), 3) << run.out;
  EXPECT_TRUE(Holds(run.out, "pipe_001.png  axial 7")) << run.out;
  EXPECT_TRUE(Holds(run.err, "not used: ") && Holds(run.err, "pipe_000_bad.png")) << run.err;
  EXPECT_EQ(nlohmann::json::parse(ReadAll(out / "strain.json")).at("states").size(), 3u);
}

TEST_F(Watch, AHalfWrittenImageIsWaitedFor) {
  const fs::path out = Calibrated("out");
  const std::string bytes = ReadAll(scratch() / "camera/pipe_000.png");
  RunningTelestrain program(WatchInto(out, {"--until", "2"}));
  {
    std::ofstream slow(arriving() / "pipe_000.png", std::ios::binary);
    for (std::size_t part = 0; part < 4; ++part) {
      slow << bytes.substr(part * (bytes.size() / 4 + 1), bytes.size() / 4 + 1) << std::flush;
      std::this_thread::sleep_for(300ms);
    }
  }
  Arrive(1);
  const ProgramRun run = program.Wait();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_FALSE(Holds(run.err, "not used")) << run.err;
}

TEST_F(Watch, ASignalEndsItWithWholeResultsAndTheNextGoesOn) {
  const fs::path out = Calibrated("out"), other = Calibrated("other");
  fs::copy_file(scratch() / "pipe.csv", arriving() / "pipe.csv");
  {
    // The table names images of a folder below it; they are matched by their names.
    RunningTelestrain program(WatchInto(out, {}));
    Arrive(1);
    for (int i = 0; i < 6000 && !Holds(program.ErrSoFar(), "waits for"); ++i)
      std::this_thread::sleep_for(10ms);
    EXPECT_FALSE(fs::exists(out / "strain.csv"));
    Arrive(0);
    AwaitLines(out / "strain.csv", 3);
    program.Signal(SIGINT);
    const ProgramRun run = program.Wait();
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(ReadAll(out / "strain.json")).at("states").size(), 2u);
    EXPECT_TRUE(Holds(run.err, "pipe_001.png waits for the reference, pipe_000.png"));
  }
  Arrive(2);
  const ProgramRun run = RunTelestrain(WatchInto(out, {"--idle-s", "1"}));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(LinesOfText(run.out, "known"), 2) << run.out;
  ASSERT_EQ(RunTelestrain(WatchInto(other, {"--until", "3"})).exit_code, 0);
  // The trail tells of the measurement that was ended after two states.
  EXPECT_EQ(DifferingFiles(other, out), std::vector<std::string>{"audit.jsonl"});
  EXPECT_TRUE(Holds(ReadAll(out / "strain.csv"), "pipe/pipe_001.png,1,1,")) << "the table's step";
}

TEST_F(Watch, AKillLeavesStatesThatTheNextRunTakesOver) {
  const fs::path out = Calibrated("out"), other = Calibrated("other");
  for (const int image : {0, 1, 2}) Arrive(image);
  {
    RunningTelestrain program(WatchInto(out, {}));
    AwaitLines(out / "strain_states.jsonl", 1);
    program.Signal(SIGKILL);
  }
  ASSERT_EQ(RunTelestrain(WatchInto(out, {"--until", "3"})).exit_code, 0);
  ASSERT_EQ(RunTelestrain(WatchInto(other, {"--until", "3"})).exit_code, 0);
  EXPECT_EQ(DifferingFiles(other, out), std::vector<std::string>());
}

TEST_F(Watch, AFolderThatIsNotThereIsAnError) {
  fs::remove(arriving());
  const ProgramRun run = RunTelestrain(WatchInto(results(), {}));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(Holds(run.err, "--watch")) << run.err;
}

}  // namespace
}  // namespace telestrain::testing_support
