// The program itself on what would hang it or fill the memory: few cases, since each starts it.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>

#include <chrono>
#include <fstream>

#include "base/utf8.h"
#include "cli/session_copy.h"
#include "robustness/bad_input/damaged_folder.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

// The program without any input takes 145 MB here, most of it its libraries.
constexpr long kMostMemory_kib = 400 * 1024;
// Ten times what starting the program takes on a busy machine.
constexpr double kMostTime_s = 20;

class HostileInput : public SessionCopy {
 protected:
  // Ends with `code`, with one line that holds `words` and a remedy, soon and in little memory, and
  // leaves the session as it was.
  void ExpectEnd(const std::vector<std::string>& arguments, int code, const std::string& words) {
    SCOPED_TRACE(arguments.front() + ": " + words);
    const auto begin = std::chrono::steady_clock::now();
    const ProgramRun run = RunTelestrain(arguments);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_TRUE(run.err.starts_with("telestrain ")) << run.err;
    EXPECT_EQ(FaultOfMessage(run.err, ""), "") << run.err;
    const std::string line = run.err.substr(0, run.err.find('\n'));
    EXPECT_EQ(PrintableText(line), line);
    EXPECT_LT(run.peak_memory_kib, kMostMemory_kib);
    EXPECT_LT(spent.count(), kMostTime_s);
    EXPECT_FALSE(fs::exists(results()));
  }
  std::vector<std::string> Detect() const {
    return {"detect", session().string(), "--out", results().string()};
  }
  std::string Pipe(const std::string& file) {
    const fs::path path = session() / file;
    fs::remove(path);
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return path;
  }
  std::string Link(const std::string& file, const fs::path& target) {
    const fs::path path = session() / file;
    fs::remove(path);
    fs::create_symlink(target, path);
    return path;
  }
};

TEST_F(HostileInput, PipesInPlaceOfFilesAreNotWaitedFor) {
  for (const std::string file : {"session.toml", "pipe.csv", "ruler/ruler_001.png"}) {
    Pipe(file);
    ExpectEnd(Detect(), 3, "file was expected");
    fs::remove(session() / file);
    fs::copy_file(SmallSession() / file, session() / file);
  }
  const std::string pipe = Pipe("pipe.csv"), image = (session() / "pipe/pipe_000.png").string();
  ExpectEnd({"correlate", pipe, "--out", results().string()}, 3, "is a named pipe");
  ExpectEnd({"correlate", image, image, "--region", pipe, "--out", results().string()}, 3,
            "is a named pipe");
  ExpectEnd({"sign", pipe, "--role", "operator", "--p12", pipe}, 3, "is a named pipe");
  ExpectEnd({"design", pipe, "--out", results().string()}, 3, "is a named pipe");
}

TEST_F(HostileInput, DevicesAreNotReadToTheirEnd) {
  ExpectEnd({"correlate", "/dev/zero", "--out", results().string()}, 3, "is a device");
  Link("pipe.csv", "/dev/zero");
  ExpectEnd(Detect(), 3, "leaves the session folder");
}

TEST_F(HostileInput, HugeFilesAreRefusedByTheirSize) {
  fs::resize_file(session() / "session.toml", std::uintmax_t{8} << 30);
  ExpectEnd(Detect(), 3, "the limit is 1048576");
  fs::copy_file(SmallSession() / "session.toml", session() / "session.toml",
                fs::copy_options::overwrite_existing);
  fs::resize_file(session() / "pipe/pipe_001.png", std::uintmax_t{8} << 30);
  ExpectEnd(Detect(), 3, "pipe_001.png: has 8589934592 bytes");
}

TEST_F(HostileInput, NamesThatMoveTheCursorArePrintedSafely) {
  for (const std::string name : {"a\nb\x1b[31m", "\xff\xfe", "\xE2\x80\xAEgnp"})
    ExpectEnd({"detect", (scratch() / name).string(), "--out", results().string()}, 3,
              PrintableText(name));
  ExpectEnd({"detect", std::string(5000, 'x'), "--out", results().string()}, 3, "session.toml");
}

TEST_F(HostileInput, EmptyArgumentsAreNoFolders) {
  for (const std::string verb : {"render", "report", "review", "diagnose"}) {
    const ProgramRun run = RunTelestrain({verb, ""});
    EXPECT_TRUE(run.exit_code == 2 || run.exit_code == 3) << verb << run.exit_code << run.err;
  }
}

}  // namespace
}  // namespace telestrain::testing_support
