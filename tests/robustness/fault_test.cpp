// Two programs in one folder, runs that are repeated, signals, and what the system refuses.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include "robustness/disturbed_run.h"
#include "robustness/fault_folder.h"
#include "robustness/fault_subject.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t LinesOf(const fs::path& file) {
  std::ifstream stream(file);
  std::size_t lines = 0;
  for (std::string line; std::getline(stream, line);) ++lines;
  return lines;
}

TEST_F(Faults, WhileOneProgramHoldsAFolderEveryOtherThatWouldWriteIsRefusedAtOnce) {
  const fs::path out = Copy("held");
  const std::string session = SmallSession().string(), pdf = (out / "report.pdf").string();
  const int held = ::open(out.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX | LOCK_NB), 0);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           RunInto(out),
           {"detect", session, "--out", out},
           {"calibrate", session, "--out", out},
           {"verify", session, "--out", out},
           {"measure", session, "--out", out},
           {"measure", session, "--out", out, "--watch", Scratch()},
           {"diagnose", out},
           {"render", out},
           {"render", out, "--view", "array", "--out", Scratch() / "array.png"},
           {"report", out},
           {"review", out},
           {"export", out, "--out", Scratch() / "exported"},
           {"sign", pdf, "--role", "operator", "--p12", "none.p12"}}) {
    const ProgramRun run = RunTelestrain(words);
    EXPECT_EQ(run.exit_code, 5) << words[0] << ": " << run.err;
    EXPECT_TRUE(Holds(run.err, out.string() + ": is in use by process " +
                                   std::to_string(::getpid()) + "; wait until"))
        << run.err;
    EXPECT_EQ(run.out, "") << words[0];
  }
  EXPECT_EQ(RunTelestrain({"audit", "verify", out}).exit_code, 0) << "readers do not ask";
  ::close(held);
  ExpectAsUndisturbed(out);
  EXPECT_EQ(RunTelestrain({"verify", session, "--out", out}).exit_code, 0);
}

TEST_F(Faults, AWatchHoldsItsFolderUntilASignalEndsIt) {
  const fs::path out = Copy("watched"), folder = Scratch() / "arriving";
  const fs::path left_behind = out / "strain.csv.telestrain-part-99999999";
  fs::create_directories(folder);
  std::ofstream(left_behind) << "half";
  RunningTelestrain watch(
      {"measure", SmallSession().string(), "--out", out.string(), "--watch", folder.string()});
  // Who holds the folder clears it.
  while (fs::exists(left_behind) && !watch.HasEnded()) std::this_thread::sleep_for(5ms);
  EXPECT_EQ(RunTelestrain({"diagnose", out}).exit_code, 5);
  watch.Signal(SIGKILL);
  watch.Wait();
  EXPECT_EQ(RunTelestrain({"diagnose", out}).exit_code, 0) << "a killed program holds nothing";
}

TEST_F(Faults, AFinishedRunThatIsRepeatedChangesNothing) {
  const fs::path out = Copy("repeated");
  std::map<std::string, fs::file_time_type> before;
  for (const auto& entry : fs::recursive_directory_iterator(out))
    before[entry.path()] = entry.last_write_time();
  const ProgramRun run = RunTelestrain(RunInto(out));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* step :
       {"detect     kept", "calibrate  kept", "diagnose   kept", "verify     kept",
        "measure    kept", "render     kept", ", kept: made", "verdict    pass"})
    EXPECT_TRUE(Holds(run.out, step)) << run.out;
  for (const auto& entry : fs::recursive_directory_iterator(out))
    EXPECT_EQ(before[entry.path()], entry.last_write_time()) << entry.path();
  ExpectAsUndisturbed(out);
}

TEST_F(Faults, AFinishedRunThatWasLookedAtIsKept) {
  const fs::path out = Copy("looked_at");
  const std::string report = ReadAll(out / "report.pdf");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"render", out, "--view", "side"}, RunInto(out)}) {
    const ProgramRun run = RunTelestrain(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(words != RunInto(out) || Holds(run.out, "render     kept")) << run.out;
  }
  EXPECT_TRUE(ReadAll(out / "report.pdf") == report);
  EXPECT_TRUE(fs::exists(out / "pictures/side.png"));
  const ProgramRun audit = RunTelestrain({"audit", "verify", out});
  EXPECT_EQ(audit.exit_code, 0) << audit.out;
}

TEST_F(Faults, WhatWasChangedOrTakenAwayIsMadeAgain) {
  const fs::path out = Copy("tampered");
  std::ofstream(out / "strain.csv", std::ios::app) << "a line more\n";
  std::ofstream(out / "pipe_003.vtp") << "a state more";
  fs::remove(out / "mrcal.json");
  fs::remove(out / "pictures/array.png");
  std::ofstream(out / "results.json.telestrain-part-99999999") << "half";
  std::ofstream(out / "pictures/array.png.telestrain-part-99999999") << "half";
  const ProgramRun run = RunTelestrain(RunInto(out));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* step : {"detect     kept", "calibrate  kept", "verify     kept"})
    EXPECT_TRUE(Holds(run.out, step)) << run.out;
  for (const char* step : {"diagnose   kept", "measure    kept", "render     kept", ", kept: made"})
    EXPECT_FALSE(Holds(run.out, step)) << run.out;
  ExpectAsUndisturbed(out);
}

// The long forms are fault_kill and fault_writes.
class EndedRun : public Faults {
 protected:
  static const FaultSubject& Subject() {
    static const FaultSubject subject = [] {
      const fs::path before = Copy("before_the_end");
      for (const char* name : {"mrcal.json", "results.json", "dcc.xml"}) fs::remove(before / name);
      return FaultSubject(Scratch() / "subject", before, Results());
    }();
    return subject;
  }
};

TEST_F(EndedRun, KilledAtAnyCallGoesOn) {
  EXPECT_EQ(BrokenFiles(Results()), std::vector<std::string>());
  for (const long at : {4, 17}) {
    Subject().Reset();
    const ProgramRun run =
        RunTelestrain(Subject().words(), {".", ShimEnvironment(Subject().results(), {at})});
    EXPECT_EQ(run.exit_code, 128 + SIGKILL) << at;
    EXPECT_EQ(Subject().AfterEnding(true), "") << at;
    EXPECT_EQ(Subject().AfterRepeating(), "") << at;
  }
}

TEST_F(EndedRun, AWriteThatFailsIsSaidAndLeavesWholeFiles) {
  const FaultSubject& subject = Subject();
  for (const auto& [at, error] : {std::pair{1, EROFS}, std::pair{4, EIO}, std::pair{12, ENOSPC}}) {
    subject.Reset();
    const ProgramRun run = RunTelestrain(
        subject.words(), {".", ShimEnvironment(subject.results(), {at, error, error == ENOSPC})});
    EXPECT_EQ(run.exit_code, 5) << at;
    for (const std::string& part :
         {subject.results().string(), ": " + std::string(std::strerror(error)) + "; "})
      EXPECT_TRUE(Holds(run.err, part)) << part << " is not in: " << run.err;
    EXPECT_EQ(subject.AfterEnding(false), "") << at;
    EXPECT_EQ(subject.AfterRepeating(), "") << at;
  }
}

TEST_F(Faults, ASignalEndsARunWithWholeFilesAndTheNextGoesOn) {
  const fs::path out = Scratch() / "ended";
  std::size_t lines = 0;
  for (const auto& [number, name] :
       {std::pair{SIGINT, "SIGINT"}, std::pair{SIGTERM, "SIGTERM"}, std::pair{SIGHUP, "SIGHUP"}}) {
    RunningTelestrain program(RunInto(out));
    while (LinesOf(out / "audit.jsonl") <= lines && !program.HasEnded())
      std::this_thread::sleep_for(2ms);
    program.Signal(number);
    const ProgramRun run = program.Wait();
    ASSERT_EQ(run.exit_code, 128 + number) << run.err;
    EXPECT_TRUE(run.err.ends_with("telestrain run: ended by " + std::string(name) +
                                  "; what is finished is kept in " + out.string() +
                                  ", the same command goes on from there\n"))
        << run.err;
    EXPECT_EQ(TemporariesIn(out), std::vector<std::string>());
    EXPECT_EQ(BrokenFiles(out), std::vector<std::string>());
    lines = LinesOf(out / "audit.jsonl");
  }
  ASSERT_EQ(RunTelestrain(RunInto(out)).exit_code, 0);
  ExpectAsUndisturbed(out);
}

TEST_F(Faults, ASignalThatIsIgnoredStaysIgnored) {
  const fs::path out = Copy("ignored");
  const ProgramRun run =
      // Once it has its results folder, the program has long looked at its signals.
      Shell(R"(trap '' HUP; $TELESTRAIN diagnose $OUT & program=$!
until grep -q "FLOCK .* $program " /proc/locks || ! kill -0 $program; do :; done
kill -HUP $program && echo sent; wait $program)",
            out);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(Holds(run.out, "sent")) << run.out;
}

TEST_F(Faults, AReaderThatGoesAwayLosesNoResults) {
  const fs::path out = Copy("unread");
  fs::remove(out / "report.pdf");
  const ProgramRun run =
      Shell("$TELESTRAIN run $SESSION --out $OUT | head -1; exit ${PIPESTATUS[0]}", out);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  ExpectAsUndisturbed(out);
}

TEST_F(Faults, OutputThatCannotBeSaidIsAnError) {
  const fs::path out = Copy("unsaid");
  for (const char* line :
       {"$TELESTRAIN diagnose $OUT > /dev/full", "$TELESTRAIN --help > /dev/full"}) {
    const ProgramRun run = Shell(line, out);
    EXPECT_EQ(run.exit_code, 5) << line;
    EXPECT_TRUE(Holds(run.err, "standard output")) << run.err;
  }
  // No file of results takes the number of a closed stream.
  EXPECT_EQ(Shell("$TELESTRAIN diagnose $OUT >&- 2>&- <&-", out).exit_code, 0);
  EXPECT_EQ(ReadAll(out / "mrcal.json"), ReadAll(Results() / "mrcal.json"));
}

TEST_F(Faults, APasswordThatIsNotTypedLeavesTheTerminalAsItWas) {
  const std::string pem = (Scratch() / "locked.pem").string();
  const ProgramRun made = Shell(
      "openssl req -x509 -newkey rsa:2048 -passout pass:x -subj /CN=x "
      "-keyout " +
          pem + " -out " + pem + ".cert",
      "");
  if (made.exit_code != 0) GTEST_SKIP() << "openssl, which makes a locked key, is not there";
  const fs::path out = Copy("unsigned");
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0);
  const std::string line = std::string(::ptsname(terminal));
  const pid_t child = ::fork();
  if (child == 0) {
    ::setsid();
    const int own = ::open(line.c_str(), O_RDWR);
    for (const int number : {0, 1, 2}) ::dup2(own, number);
    ::execl(TelestrainPath().c_str(), "telestrain", "sign", (out / "report.pdf").c_str(), "--role",
            "operator", "--key", pem.c_str(), "--cert", (pem + ".cert").c_str(), nullptr);
    ::_exit(127);
  }
  std::string said;
  for (char c = 0; !Holds(said, "Password of") && ::read(terminal, &c, 1) == 1;) said += c;
  termios state{};
  for (int i = 0; i < 500 && (::tcgetattr(terminal, &state), (state.c_lflag & ECHO) != 0); ++i)
    std::this_thread::sleep_for(10ms);
  EXPECT_EQ(state.c_lflag & ECHO, 0u) << "the password would be shown";
  ASSERT_EQ(::write(terminal, "\x03", 1), 1);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT) << said;
  ::tcgetattr(terminal, &state);
  EXPECT_NE(state.c_lflag & ECHO, 0u);
  ::close(terminal);
  ExpectAsUndisturbed(out);
}

}  // namespace
}  // namespace telestrain::testing_support
