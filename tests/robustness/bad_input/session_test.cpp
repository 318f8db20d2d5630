// A session whose description or tables are damaged: read, or refused with file and remedy.
#include "session/session.h"

#include <gtest/gtest.h>

#include "robustness/bad_input/damaged_folder.h"
#include "unit/base/scratch_folder.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

class DamagedSession : public ::testing::Test {
 protected:
  DamagedSession() : scratch_("telestrain_bad_session_"), folder_(Copy(scratch_.path())) {}

  int Refusals(const std::string& file, const std::vector<Damaged>& damages) {
    return folder_.ExpectRefusedOrTaken(file, damages, [this]() -> std::optional<Error> {
      const auto session = ReadSession(folder_.path());
      return session ? std::nullopt : std::optional(session.error());
    });
  }
  // Each must be refused, in words that hold `words`.
  void ExpectRefused(const std::string& file, const std::string& bytes, const std::string& words) {
    SCOPED_TRACE(words);
    folder_.ExpectRefusedOrTaken(file, {{words, bytes}}, [&]() -> std::optional<Error> {
      const auto session = ReadSession(folder_.path());
      EXPECT_FALSE(session.ok());
      if (session) return std::nullopt;
      EXPECT_NE(session.error().message.find(words), std::string::npos) << session.error().message;
      return session.error();
    });
  }
  std::string Bytes(const std::string& file) const { return folder_.Bytes(file); }
  const fs::path& Folder() const { return folder_.path(); }

 private:
  // The images are only looked for, so that short ones do.
  static fs::path Copy(const fs::path& scratch) {
    for (const auto& [file, bytes] : BytesBelow(SmallSession())) {
      fs::create_directories((scratch / file).parent_path());
      if (file.ends_with(".png"))
        fs::copy_file(SmallSession() / file, scratch / file), fs::resize_file(scratch / file, 16);
      else
        fs::copy_file(SmallSession() / file, scratch / file);
    }
    return scratch;
  }

  ScratchFolder scratch_;
  DamagedFolder folder_;
};

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST_F(DamagedSession, EveryKeyRemovedDoubledOrOfAnotherKind) {
  const auto damages = TomlDamages(Bytes("session.toml"));
  ASSERT_GT(damages.size(), 500U);
  // Most keys are required, none may stand twice, and few of the values fit anywhere.
  EXPECT_GT(Refusals("session.toml", damages), static_cast<int>(damages.size() * 6 / 10));
}

TEST_F(DamagedSession, EveryFileCutShortOrWithAByteChanged) {
  for (const std::string file : {"session.toml", "calibration.csv", "ruler.csv", "pipe.csv"}) {
    EXPECT_GT(Refusals(file, Truncations(Bytes(file), 60)), 0) << file;
    EXPECT_GT(Refusals(file, Flips(Bytes(file), 120)), 0) << file;
  }
}

TEST_F(DamagedSession, DescriptionsThatWouldFillStackOrMemory) {
  const std::string toml = Bytes("session.toml");
  const auto times = [](int count, const std::string& word) {
    std::string all;
    for (int i = 0; i < count; ++i) all += word;
    return all;
  };
  ExpectRefused("session.toml", "", "the key 'schema' is missing");
  ExpectRefused("session.toml", times(200000, "[\n"), "session.toml:");
  ExpectRefused("session.toml", "a = " + times(4000, "{b = ") + "1\n" + toml, "session.toml:1: ");
  ExpectRefused("session.toml", times(5000, "a.") + "a = 1\n" + toml, "deep");
  ExpectRefused("session.toml", "a = '" + times(20000, "x") + "'\n" + toml, "the line has");
  ExpectRefused("session.toml", toml + times(600000, "# x\n"), "the limit is 1048576");
  ExpectRefused("session.toml", toml + times(40000, "[[view]]\n"), "view");
  std::string keys;
  for (int i = 0; i < 50000; ++i) keys += "key_" + std::to_string(i) + " = 1\n";
  ExpectRefused("session.toml", keys + toml, "unknown key");
}

TEST_F(DamagedSession, OtherEncodings) {
  for (const std::string file : {"session.toml", "calibration.csv"}) {
    std::string wide = "\xff\xfe";
    for (const char c : Bytes(file)) wide += std::string{c, '\0'};
    ExpectRefused(file, wide, "not UTF-8");
    EXPECT_EQ(Refusals(file, {{"mark of UTF-8", "\xEF\xBB\xBF" + Bytes(file)}}), 0);
  }
  ExpectRefused("calibration.csv",
                Replaced(Bytes("calibration.csv"), "P001", std::string("P\0", 2)),
                "control character \\x00");
  ExpectRefused("session.toml", Replaced(Bytes("session.toml"), "title = \"", "title = \"\\u001b"),
                "control characters");
}

TEST_F(DamagedSession, TablesOfEndlessWidthOrLength) {
  const std::string table = Bytes("calibration.csv");
  std::string wide = "image,pose,stage_mm", long_one = "image,pose,stage_mm\n";
  for (int i = 0; i < 100000; ++i) wide += ",c" + std::to_string(i);
  ExpectRefused("calibration.csv", wide + "\n", "the limit is 256");
  ExpectRefused("calibration.csv", table + std::string(1000000, ',') + "\n", "1000001 cells");
  for (int i = 0; i < 300000; ++i) long_one += "a" + std::to_string(i) + ".png,P,0\n";
  ExpectRefused("calibration.csv", long_one, "the limit is 4194304");
  ExpectRefused("calibration.csv", "image,pose,stage_mm\n", "has no rows");
}

TEST_F(DamagedSession, NumbersThatAreNone) {
  for (const std::string number :
       {"1e999", "nan", "-inf", "0x10", "1;5", "\"1,5\"", "", "1e", "--1"})
    ExpectRefused(
        "calibration.csv",
        Replaced(Bytes("calibration.csv"), "stage_1.png,P001,1", "stage_1.png,P001," + number),
        "calibration.csv:3: the cell 'stage_mm'");
}

TEST_F(DamagedSession, PathsThatLeaveIt) {
  const std::string first = "calibration/pose_001_stage_0.png";
  for (const char* path :
       {"/etc/passwd", "../../etc/passwd", "calibration/../../x.png", "..", "//etc/passwd"})
    ExpectRefused("calibration.csv", Replaced(Bytes("calibration.csv"), first, path),
                  "leaves the session folder");
  for (const std::string& path :
       {std::string(5000, 'a'), std::string("calibration"), std::string("~/x.png"), first + "/"})
    ExpectRefused("calibration.csv", Replaced(Bytes("calibration.csv"), first, path),
                  "calibration.csv:2: the image");
}

TEST_F(DamagedSession, LinksThatLeaveItButNotThoseThatStay) {
  const ScratchFolder outside("telestrain_bad_outside_");
  for (const std::string file : {"session.toml", "calibration.csv", "ruler.csv", "pipe.csv",
                                 "ruler/ruler_001.png", "pipe/pipe_001.png"}) {
    SCOPED_TRACE(file);
    const fs::path name = Folder() / file, copy = outside.path() / name.filename();
    fs::rename(name, copy);
    fs::create_symlink(copy, name);
    const auto refused = ReadSession(Folder());
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("leaves the session folder by a symbolic link"),
              std::string::npos)
        << refused.error().message;
    fs::remove(name);
    fs::rename(copy, Folder() / "moved");
    fs::create_symlink(Folder() / "moved", name);
    const auto taken = ReadSession(Folder());
    EXPECT_TRUE(taken.ok()) << taken.error().message;
    fs::rename(Folder() / "moved", name);
  }
}

}  // namespace
}  // namespace telestrain::testing_support
