#include <gtest/gtest.h>
#include <unistd.h>

#include "session/session.h"
#include "tests/unit/session/sample_folder.h"

namespace telestrain {
namespace {

// The message of the error that reading `folder` ends with.
std::string MessageOf(const SampleFolder& sample) {
  const auto session = ReadSession(sample.path());
  EXPECT_FALSE(session.ok());
  return session.ok() ? "" : session.error().message;
}

void ExpectSays(const std::string& message, const std::string& words) {
  EXPECT_NE(message.find(words), std::string::npos) << message << "\nlacks: " << words;
}

TEST(ReadSessionErrorTest, FolderWithoutSession) {
  const SampleFolder sample("no_toml");
  sample.Remove("session.toml");
  ExpectSays(MessageOf(sample), "session.toml: does not exist; give a session folder");
}

TEST(ReadSessionErrorTest, CalibrationTableMissing) {
  const SampleFolder sample("no_calibration");
  sample.Remove("calibration.csv");
  ExpectSays(MessageOf(sample), "make it with the columns image, pose, stage_mm");
}

TEST(ReadSessionErrorTest, NoViews) {
  const SampleFolder sample("no_views");
  const std::string text = sample.Read("session.toml");
  const auto views = text.find("[[view]]"), stage = text.find("[stage]");
  sample.Write("session.toml", "view = []\n" + text.substr(0, views) + text.substr(stage));
  ExpectSays(MessageOf(sample), "session.toml:1: 'view' has no entry");
  sample.Write("session.toml", text.substr(0, views) + text.substr(stage));
  ExpectSays(MessageOf(sample), "add it: one or more tables [[view]]");
}

TEST(ReadSessionErrorTest, NoBoards) {
  const SampleFolder sample("no_boards");
  const std::string text = sample.Read("session.toml");
  const auto boards = text.find("[[target.board]]"), ruler = text.find("[ruler]");
  sample.Write("session.toml", text.substr(0, boards) + "board = []\n" + text.substr(ruler));
  ExpectSays(MessageOf(sample), "[target] has no board; add one [[target.board]] per group");
}

TEST(ReadSessionErrorTest, RulerImagesWithoutRuler) {
  const SampleFolder sample("no_ruler");
  sample.Replace("session.toml", "[ruler]\nlength_mm = 27.6\nsigma_length_um = 0.25\n", "");
  ExpectSays(MessageOf(sample), "ruler.csv:2: lists images, but");
  ExpectSays(MessageOf(sample), "has no [ruler]; add [ruler] there or remove");
}

TEST(ReadSessionErrorTest, PipeImagesWithoutPipe) {
  const SampleFolder sample("no_pipe");
  sample.Replace("session.toml",
                 "[pipe]\nouter_diameter_mm = 8.0\npoisson_ratio = 0.31\nmaterial = \"copper\"\n",
                 "");
  ExpectSays(MessageOf(sample), "pipe.csv:2: lists images, but");
}

TEST(ReadSessionErrorTest, GaugeWithoutReadingsOrTwice) {
  const SampleFolder sample("gauge_places");
  const std::string place = "material = \"copper\"\n";
  const std::string gauge = "[[pipe.gauge]]\naxial_mm = 0\nangle_deg = 90\ncolumn = ";
  sample.Replace("session.toml", place, place + gauge + "\"gauge_2_microstrain\"\n");
  ExpectSays(MessageOf(sample), "pipe.csv:1: has no gauge column 'gauge_2_microstrain'");
  ExpectSays(MessageOf(sample), "nearest column: 'gauge_1_microstrain'");
  const std::string there = gauge + "\"gauge_1_microstrain\"\n";
  sample.Replace("session.toml", gauge + "\"gauge_2_microstrain\"\n", there + there);
  ExpectSays(MessageOf(sample), "column 'gauge_1_microstrain' has two [[pipe.gauge]]");
}

TEST(ReadSessionErrorTest, LinkToNowhereIsNoAbsentTable) {
  const SampleFolder sample("dangling");
  sample.Remove("ruler.csv");
  std::filesystem::create_symlink("nowhere.csv", sample.path() / "ruler.csv");
  ExpectSays(MessageOf(sample), "ruler.csv: cannot be read");
}

TEST(ReadSessionErrorTest, LinksThatLeaveTheFolder) {
  const SampleFolder outside("links_outside"), sample("links");
  const auto link = sample.path() / "images/c1.png";
  sample.Remove("images/c1.png");
  std::filesystem::create_symlink(outside.path() / "images/c1.png", link);
  ExpectSays(MessageOf(sample), "calibration.csv:3: the image 'images/c1.png' leaves the session");
  ExpectSays(MessageOf(sample), "copy the file itself into the folder");
  sample.Remove("images/c1.png");
  std::filesystem::create_symlink("../../nowhere.png", link);
  ExpectSays(MessageOf(sample), "calibration.csv:3: the image 'images/c1.png' ");
  sample.Remove("images");
  std::filesystem::create_directory_symlink(outside.path() / "images", sample.path() / "images");
  ExpectSays(MessageOf(sample), "calibration.csv:2: the image 'images/c0.png' leaves the session");
}

TEST(ReadSessionErrorTest, LinksWithinTheFolder) {
  const SampleFolder sample("inner_links"), other("link_to");
  sample.Write("raw/1.png", "not decoded");
  sample.Remove("images/c1.png");
  std::filesystem::create_symlink("../raw/1.png", sample.path() / "images/c1.png");
  EXPECT_TRUE(ReadSession(sample.path()).ok());
  // The session folder itself may be a link, and relative.
  std::filesystem::create_directory_symlink(sample.path(), other.path() / "session");
  EXPECT_TRUE(ReadSession(other.path() / "session").ok());
  EXPECT_TRUE(ReadSession(std::filesystem::relative(sample.path())).ok());
  sample.Remove("images/c1.png");
  std::filesystem::create_symlink("c0.png", sample.path() / "images/c1.png");
  ExpectSays(MessageOf(sample), "calibration.csv:3: the image 'images/c1.png' is already used at");
}

TEST(ReadSessionErrorTest, PathsThatCannotBeFollowed) {
  const SampleFolder sample("bad_paths");
  sample.Remove("images/c1.png");
  std::filesystem::create_symlink("c1.png", sample.path() / "images/c1.png");
  ExpectSays(MessageOf(sample), "calibration.csv:3: the image 'images/c1.png' ");
  sample.Replace("calibration.csv", "images/c1.png", "images/" + std::string(5000, 'x') + ".png");
  ExpectSays(MessageOf(sample), "calibration.csv:3: the image 'images/xxx");
  sample.Replace("calibration.csv", "images/" + std::string(5000, 'x'), "images/c0.png/x");
  ExpectSays(MessageOf(sample), "calibration.csv:3: the image 'images/c0.png/x.png' ");
  for (const auto& folder : {sample.path() / std::string(5000, 'x'), sample.path() / "pipe.csv",
                             sample.path() / "images/c1.png"}) {
    const auto session = ReadSession(folder);
    ASSERT_FALSE(session.ok());
    EXPECT_EQ(session.error().kind, ErrorKind::kBadInput);
  }
}

TEST(ReadSessionErrorTest, UnreadableImage) {
  if (::geteuid() == 0) GTEST_SKIP() << "root reads everything";
  const SampleFolder sample("unreadable");
  std::filesystem::permissions(sample.path() / "images/c1.png", std::filesystem::perms::none);
  ExpectSays(MessageOf(sample), "calibration.csv:3: the image 'images/c1.png' cannot be read");
}

TEST(ReadSessionErrorTest, ZeroByteInAPath) {
  const SampleFolder sample("zero_byte");
  sample.Replace("calibration.csv", "images/c1.png", std::string("images/c1.png\0.x", 16));
  ExpectSays(MessageOf(sample),
             "calibration.csv:3: byte 14 of the line is the control character \\x00");
}

TEST(ReadSessionErrorTest, NestingAndLineLengthAreBounded) {
  const SampleFolder sample("nesting");
  const std::string text = sample.Read("session.toml");
  sample.Write("session.toml", "a.a.a.a.a.a.a.a.a.a = 1\n" + text);
  ExpectSays(MessageOf(sample), "session.toml:1: tables and arrays are nested more than 8 deep");
  sample.Write("session.toml", text + "\nlong = \"" + std::string(20000, 'x') + "\"\n");
  ExpectSays(MessageOf(sample), "bytes, the limit is 16384; break it into several lines");
}

TEST(ReadSessionErrorTest, TablesOfASpreadsheetWithOtherSeparators) {
  const SampleFolder sample("separators");
  sample.Write("calibration.csv", "image;pose;stage_mm\na.png;1;0\n");
  ExpectSays(MessageOf(sample),
             "calibration.csv:1: the columns are parted by ';'; write the table");
  sample.Write("calibration.csv", "image\tpose\tstage_mm\na.png\t1\t0\n");
  ExpectSays(MessageOf(sample), "the columns are parted by 'tab'");
}

TEST(ReadSessionErrorTest, TablesAreNotLongerThanResultsCanTell) {
  const SampleFolder sample("rows");
  std::string text = "image,pose,stage_mm\n";
  for (int i = 0; i <= 5000; ++i) text += "a.png,1,0\n";
  sample.Write("calibration.csv", text);
  ExpectSays(MessageOf(sample), "calibration.csv: has 5001 rows, the limit is 5000; divide it");
}

}  // namespace
}  // namespace telestrain
