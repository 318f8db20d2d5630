// What the system refuses: names, sizes, memory, space.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "robustness/disturbed_run.h"
#include "robustness/fault_folder.h"
#include "robustness/fault_subject.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Faults, AFileInThePlaceOfTheFolderIsSaid) {
  const fs::path out = Scratch() / "a_file";
  std::ofstream(out) << "no folder";
  const ProgramRun run = RunTelestrain(RunInto(out));
  EXPECT_EQ(run.exit_code, 5);
  EXPECT_TRUE(Holds(run.err, out.string() + ": cannot be made a folder: a file has that name"))
      << run.err;
  EXPECT_EQ(ReadAll(out), "no folder");
}

TEST_F(Faults, ALimitOnFileSizesIsSaid) {
  const fs::path out = Copy("limited");
  fs::remove(out / "report.pdf");
  const ProgramRun run = Shell("ulimit -f 1000; $TELESTRAIN report $OUT", out);
  EXPECT_EQ(run.exit_code, 5);
  EXPECT_TRUE(Holds(run.err, "report.pdf: cannot be written: File too large; allow larger files"))
      << run.err;
  EXPECT_EQ(TemporariesIn(out), std::vector<std::string>());
  ASSERT_EQ(RunTelestrain(RunInto(out)).exit_code, 0);
  ExpectAsUndisturbed(out);
}

// From what the program itself is loaded in, in steps, to what a whole run takes.
TEST_F(Faults, TooLittleMemoryIsSaid) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer sets aside terabytes of addresses";
#endif
  const fs::path out = Copy("small_memory");
  fs::remove_all(out / "pictures");
  fs::remove(out / "report.pdf");
  const ProgramRun run = Shell(
      "size=250000; until (ulimit -v $size; $TELESTRAIN --version) > /dev/null 2>&1;"
      "do size=$((size + 25000)); done;"
      "for i in 1 2 3 4 5 6; do size=$((size + 50000));"
      "(ulimit -v $size; $TELESTRAIN run $SESSION --out $OUT > /dev/null); echo ended $?; done",
      out);
  EXPECT_TRUE(Holds(run.out, "ended 5")) << run.out << run.err;
  EXPECT_TRUE(Holds(run.err, "there is not enough memory")) << run.err;
  std::istringstream ends(run.out);
  for (std::string line; std::getline(ends, line);)
    EXPECT_TRUE(line == "ended 5" || line == "ended 0") << line << '\n' << run.err;
  EXPECT_EQ(TemporariesIn(out), std::vector<std::string>());
  ASSERT_EQ(RunTelestrain(RunInto(out)).exit_code, 0);
  ExpectAsUndisturbed(out);
}

// A disk of its own, in a name space of its own, is the root's.
TEST_F(Faults, AFullDiskAndOneThatMayOnlyBeReadAreSaid) {
  const fs::path disk = Scratch() / "disk", kept = Scratch() / "kept";
  fs::create_directories(disk);
  if (Shell("unshare -m mount -t tmpfs tmpfs $OUT", disk).exit_code != 0)
    GTEST_SKIP() << "no right to mount a small disk";
  // Room for all but the report.
  const std::string from = Results().string();
  const ProgramRun run = Shell(
      "unshare -m bash -c 'mount -t tmpfs -o size=$(($(du -sk " + from +
          " | cut -f1) - 700))k "
          "tmpfs $OUT; mkdir $OUT/r; (cd " +
          from +
          "; tar c --exclude=report.pdf .) | tar x -C $OUT/r;"
          "$TELESTRAIN run $SESSION --out $OUT/r; echo full $?; ls -A $OUT/r;"
          "mount -o remount,ro,size=64m $OUT; $TELESTRAIN run $SESSION --out $OUT/r; echo read $?;"
          "mount -o remount,rw $OUT; $TELESTRAIN run $SESSION --out $OUT/r; echo free $?;"
          "cp -a $OUT/r " +
          kept.string() + "'",
      disk);
  for (const char* part : {"full 5", "read 5", "free 0"})
    EXPECT_TRUE(Holds(run.out, part)) << run.out << run.err;
  EXPECT_FALSE(Holds(run.out, "telestrain-part")) << run.out;
  EXPECT_TRUE(Holds(run.err, "No space left on device; free some space")) << run.err;
  EXPECT_TRUE(Holds(run.err, "Read-only file system; choose a folder that you may write to"))
      << run.err;
  ExpectAsUndisturbed(kept);
}

}  // namespace
}  // namespace telestrain::testing_support
