#include "viz/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <thread>
#include <tuple>

#include "base/files.h"
#include "visual/results_fixture.h"
#include "viz/picture_set.h"

namespace telestrain {
namespace {

using visual_test::FreshFolder;
using visual_test::WriteResults;

// Small pictures: the same drawing code in a quarter of the time.
const RenderOptions kSmall{1200, 740};

// The pictures of the report alone, where no other is looked at.
RenderOptions Reported(RenderOptions options) {
  options.only_reported = true;
  return options;
}

Status Render(const std::filesystem::path& folder, const RenderOptions& options = kSmall) {
  std::ostringstream out, err;
  Console console(out, err, false);
  return RenderResults(folder, options, console);
}

std::string Bytes(const std::filesystem::path& path) {
  const auto bytes = ReadFile(path, kMostResultBytes);
  EXPECT_TRUE(bytes.ok()) << path;
  return bytes.ok() ? *bytes : std::string();
}

unsigned BigEndianAt(const std::string& bytes, std::size_t at) {
  unsigned value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

TEST(RenderResults, WritesPicturesOfPrintSizeWithoutADisplay) {
  unsetenv("DISPLAY");
  const auto folder = FreshFolder("PrintSize");
  WriteResults(folder);
  const Status status = Render(folder, Reported({}));
  ASSERT_TRUE(status.ok()) << status.error().message;
  for (const char* name : {"array.png", "targets.png", "pipe_strain.png"}) {
    const std::string png = Bytes(folder / "pictures" / name);
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(BigEndianAt(png, 16), 2008U);
    EXPECT_EQ(BigEndianAt(png, 20), 1240U);
    // pHYs follows IHDR: 300 dpi are 11811 px/m, unit 1; CRC of these 13 bytes by zlib.
    EXPECT_EQ(png.substr(37, 4), "pHYs") << name;
    EXPECT_EQ(BigEndianAt(png, 41), 11811U);
    EXPECT_EQ(BigEndianAt(png, 45), 11811U);
    EXPECT_EQ(png.at(49), 1);
    EXPECT_EQ(BigEndianAt(png, 50), 0x78a53f76U);
  }
}

TEST(RenderResults, GivesTheSameBytesAgainAndInAnotherThread) {
  const auto first = FreshFolder("SameBytes1"), second = FreshFolder("SameBytes2");
  WriteResults(first);
  WriteResults(second);
  ASSERT_TRUE(Render(first, Reported(kSmall)).ok());
  std::thread([&] { EXPECT_TRUE(Render(second, Reported(kSmall)).ok()); }).join();
  for (const char* name : {"array.png", "targets.png", "pipe_strain.png"})
    EXPECT_TRUE(Bytes(first / "pictures" / name) == Bytes(second / "pictures" / name)) << name;
}

TEST(RenderResults, WritesNothingButThePictures) {
  const auto folder = FreshFolder("NothingElse");
  const auto home = FreshFolder("NothingElseHome");
  setenv("HOME", home.c_str(), 1);
  setenv("XDG_CACHE_HOME", home.c_str(), 1);
  WriteResults(folder, {.ruler = false, .pipe = false});
  ASSERT_TRUE(Render(folder).ok());
  EXPECT_TRUE(std::filesystem::is_empty(home));
  EXPECT_TRUE(std::filesystem::exists(folder / "pictures/array.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures/pipe_strain.png"));
}

TEST(RenderResults, NamesTheMissingCalibrationAndItsCommand) {
  const Status status = Render(FreshFolder("NoCalibration"));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kBadInput);
  EXPECT_NE(status.error().message.find("calibration.json"), std::string::npos);
  EXPECT_NE(status.error().message.find("telestrain calibrate"), std::string::npos);
}

TEST(RenderResults, NamesTheOptionOutOfRange) {
  const auto folder = FreshFolder("OptionRange");
  RenderOptions range, huge_range;
  range.range = {5, 5};
  huge_range.range = {-1e308, 1e308};
  const std::pair<RenderOptions, const char*> wrong[] = {
      {{10, 10}, "width_px"},
      {{2008, 500}, "width_px x height_px of at least 168 x 100 mm"},
      {{16385, 1240}, "width_px"},
      {{2008, 16385}, "height_px from 1 to 16384 is wanted"},
      {{2008, 1240, 50}, "dots_per_inch from 72 to 2448"},
      {{2008, 1240, 1200}, "168 x 100 mm"},
      {huge_range, "range with ends from -1e12 to 1e12"},
      {range, "range with a low end below the high one"}};
  for (const auto& [options, part] : wrong) {
    const Status status = Render(folder, options);
    ASSERT_FALSE(status.ok()) << part;
    EXPECT_EQ(status.error().kind, ErrorKind::kUsage);
    EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
  }
}

TEST(RenderOptions, TakeEveryWidthUpToTheMostWithTheDefaultResolution) {
  for (const int width_px : {482, 2008, 16063, 16064, 16384}) {
    const Status status = CheckRenderOptions({width_px, std::min(kMostSide_px, width_px)});
    // A machine may have less memory than the largest needs.
    const bool is_taken =
        status.ok() || status.error().message.find("memory of") != std::string::npos;
    EXPECT_TRUE(is_taken) << status.error().message;
  }
}

TEST(RenderOptions, TextsKeepTheirSizeOnPaper) {
  EXPECT_EQ(RenderOptions{}.Dpi(), 300);
  EXPECT_EQ((RenderOptions{4016, 2480}.Dpi()), 600);
  EXPECT_EQ((RenderOptions{4016, 2480, 300}.Dpi()), 300);
}

TEST(RenderResults, ASingleViewLeavesTheOthersAlone) {
  const auto folder = FreshFolder("SingleView");
  WriteResults(folder, {.ruler = false, .pipe = false});
  std::filesystem::create_directories(folder / "pictures");
  ASSERT_TRUE(WriteFileAtomically(folder / "pictures/array.png", "other").ok());
  ASSERT_TRUE(WriteFileAtomically(folder / "pictures/pipe_strain_007.png", "other").ok());
  RenderOptions options = kSmall;
  options.view = "targets";
  ASSERT_TRUE(Render(folder, options).ok());
  EXPECT_EQ(Bytes(folder / "pictures/array.png"), "other");
  EXPECT_EQ(Bytes(folder / "pictures/pipe_strain_007.png"), "other");
  EXPECT_EQ(Bytes(folder / "pictures/targets.png").substr(1, 3), "PNG");
}

TEST(RenderResults, TheWholeSetTakesAwayWhatNoLongerBelongs) {
  const auto folder = FreshFolder("WholeSet");
  WriteResults(folder, {.ruler = false, .pipe = false});
  std::filesystem::create_directories(folder / "pictures");
  for (const char* name : {"pipe_strain.png", "pipe_strain_007.png", "mine.png"})
    ASSERT_TRUE(WriteFileAtomically(folder / "pictures" / name, "other").ok());
  ASSERT_TRUE(Render(folder).ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures/pipe_strain.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures/pipe_strain_007.png"));
  EXPECT_EQ(Bytes(folder / "pictures/mine.png"), "other");
}

TEST(RenderResults, WritesAViewToAFileWithTransparency) {
  const auto folder = FreshFolder("ToAFile");
  WriteResults(folder, {.ruler = false, .pipe = false});
  RenderOptions options = kSmall;
  options.view = "array";
  options.transparent = true;
  std::ostringstream out, err;
  Console console(out, err, false);
  ASSERT_TRUE(RenderResults(folder, options, console, folder / "one.png").ok());
  const std::string png = Bytes(folder / "one.png");
  EXPECT_EQ(png.at(24), 8);  // bits
  EXPECT_EQ(png.at(25), 6);  // red, green, blue, alpha
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures"));
}

// Residuals of `rows` corners of every view of the fixture, all of one length.
std::string Residuals(int rows, const std::string& error_px) {
  std::string text = "view,u_px,v_px,du_px,dv_px\n";
  for (const auto& [view, u, v] :
       {std::tuple{"A1", 0, 0}, {"A2", 0, 972}, {"B1", 1296, 0}, {"B2", 1296, 972}})
    for (int i = 0; i < rows; ++i)
      text += std::string(view) + "," + std::to_string(u + 10 + i % 1270) + "," +
              std::to_string(v + 10 + 37 * i % 950) + "," + error_px + ",0\n";
  return text;
}

TEST(RenderResults, TheWholeSetFitsOnTheLeastPaper) {
  const auto folder = FreshFolder("LeastPaper");
  WriteResults(folder);
  // As many corners, and as small errors, as a calibration of 24 poses has: long numbers.
  ASSERT_TRUE(WriteFileAtomically(folder / "residuals.csv", Residuals(2808, "0.00113")).ok());
  constexpr int kDpi = 150;
  const RenderOptions least{static_cast<int>(std::lround(viz::kLeastPaperWidth_mm / 25.4 * kDpi)),
                            static_cast<int>(std::lround(viz::kLeastPaperHeight_mm / 25.4 * kDpi)),
                            kDpi};
  const Status status = Render(folder, least);
  ASSERT_TRUE(status.ok()) << status.error().message;
  for (const char* name : {"pipe_strain_002.png", "residuals.png", "contact_sheet.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures" / name)) << name;
  for (const RenderOptions& less : {RenderOptions{least.width_px - 2, least.height_px, kDpi},
                                    RenderOptions{least.width_px, least.height_px - 2, kDpi}})
    EXPECT_FALSE(CheckRenderOptions(less).ok());
}

TEST(RenderResults, APictureThatFailsLeavesTheFolderAsItWas) {
  const auto folder = FreshFolder("FailedSet");
  WriteResults(folder, {.ruler = false, .pipe = false});
  // The last picture but the sheet has no room for a number of 80 digits.
  ASSERT_TRUE(WriteFileAtomically(folder / "residuals.csv", Residuals(1, "1e80")).ok());
  std::filesystem::create_directories(folder / "pictures");
  for (const char* name : {"array.png", "pipe_strain_007.png"})
    ASSERT_TRUE(WriteFileAtomically(folder / "pictures" / name, "old").ok());
  const Status status = Render(folder);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kOutputFailed) << status.error().message;
  EXPECT_EQ(Bytes(folder / "pictures/array.png"), "old");
  EXPECT_EQ(Bytes(folder / "pictures/pipe_strain_007.png"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "pictures"), {}), 2);
}

TEST(RenderResults, FailsAsOutputWhenThePicturesCannotBeWritten) {
  const auto folder = FreshFolder("NoRoom");
  WriteResults(folder, {.ruler = false, .pipe = false});
  ASSERT_TRUE(WriteFileAtomically(folder / "pictures", "a file in the way").ok());
  const Status status = Render(folder);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kOutputFailed);
}

}  // namespace
}  // namespace telestrain
