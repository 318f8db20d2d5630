#include "viz/video.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <sstream>

#include "base/files.h"
#include "visual/results_fixture.h"
#include "viz/palette.h"
#include "viz/pictures.h"
#include "viz/scene_from_results.h"
#include "viz/video_file.h"

namespace telestrain {
namespace {

using viz::RgbImage;

const std::filesystem::path& Results() {
  static const std::filesystem::path folder = [] {
    const auto made = visual_test::FreshFolder("Video");
    visual_test::WriteResults(made);
    return made;
  }();
  return folder;
}

std::string Bytes(const std::filesystem::path& path) {
  const auto bytes = ReadFile(path);
  EXPECT_TRUE(bytes.ok()) << path;
  return bytes.ok() ? *bytes : std::string();
}

// All frames of a film, as red, green, blue.
std::vector<cv::Mat> Decoded(const std::filesystem::path& path) {
  std::vector<cv::Mat> frames;
  cv::VideoCapture film(path.string(), cv::CAP_FFMPEG);
  for (cv::Mat bgr; film.read(bgr);) {
    frames.emplace_back();
    cv::cvtColor(bgr, frames.back(), cv::COLOR_BGR2RGB);
  }
  return frames;
}

// Root mean square over all channels, in levels of 255.
double Difference(const cv::Mat& frame, const RgbImage& image) {
  const cv::Mat wanted(image.height_px, image.width_px, CV_8UC3,
                       const_cast<std::uint8_t*>(image.rgb.data()));
  return cv::norm(frame, wanted, cv::NORM_L2) /
         std::sqrt(3.0 * static_cast<double>(image.width_px) * image.height_px);
}

struct Format {
  const char* name;
  RenderOptions options;
};
const Format kFormats[] = {{"film.mp4", {700, 432}}, {"film.gif", {640, 395}}};

Status Turn(const std::filesystem::path& file, const RenderOptions& options,
            const VideoOptions& video) {
  std::ostringstream out, err;
  Console console(out, err, false);
  return RenderTurntable(Results(), options, video, file, console);
}

TEST(Video, ATurntableHasItsFramesAndTheFirstIsThePicture) {
  const auto scene = viz::SceneFromResults(Results());
  ASSERT_TRUE(scene.ok());
  for (const auto& [name, options] : kFormats) {
    const auto file = visual_test::FreshFolder("VideoTurn") / name;
    const Status made = Turn(file, options, {0.8, 5});
    ASSERT_TRUE(made.ok()) << made.error().message;
    const auto frames = Decoded(file);
    ASSERT_EQ(frames.size(), 4u) << name;
    EXPECT_EQ(frames[0].cols, options.width_px);
    EXPECT_EQ(frames[0].rows, options.height_px);
    for (std::size_t i : {0u, 1u, 3u}) {
      const auto picture = viz::DrawTurntable(*scene, options, 90.0 * static_cast<double>(i));
      ASSERT_TRUE(picture.ok()) << picture.error().message;
      const double own = Difference(frames[i], picture->image);
      // A frame is nearer to its own picture than to the next one by far: coding costs a few
      // levels, a quarter of a turn moves everything.
      EXPECT_LT(3 * own, Difference(frames[(i + 1) % 4], picture->image)) << name << i;
    }
  }
}

TEST(Video, TheSameResultsGiveTheSameBytes) {
  for (const auto& [name, options] : kFormats) {
    const auto folder = visual_test::FreshFolder("VideoTwice");
    const auto first = folder / (std::string("first_") + name), second = folder / name;
    ASSERT_TRUE(Turn(first, options, {0.4, 5}).ok());
    ASSERT_TRUE(Turn(second, options, {0.4, 5}).ok());
    EXPECT_TRUE(Bytes(first) == Bytes(second)) << name;
    // Nothing but the two films.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 2);
  }
}

TEST(Video, ALoadCycleShowsEveryStateForItsTime) {
  const auto scene = viz::SceneFromResults(Results());
  ASSERT_TRUE(scene.ok());
  const std::size_t states = scene->pipe->states.size();
  const auto file = visual_test::FreshFolder("VideoStates") / "cycle.mp4";
  std::ostringstream out, err;
  Console console(out, err, false);
  const double seconds = 0.5 * static_cast<double>(states);
  const Status made = RenderStates(Results(), {1000, 620}, {seconds, 4}, file, console);
  ASSERT_TRUE(made.ok()) << made.error().message;
  const auto frames = Decoded(file);
  ASSERT_EQ(frames.size(), 2 * states);
  // The two frames of a state are one picture, coded twice.
  for (std::size_t i = 0; i < states; ++i)
    EXPECT_LT(cv::norm(frames[2 * i], frames[2 * i + 1], cv::NORM_L1),
              static_cast<double>(frames[0].total()) * 3);
}

TEST(Video, NamesTheOptionOutOfRange) {
  const auto folder = visual_test::FreshFolder("VideoOptions");
  const auto expect = [&](const char* name, const RenderOptions& options, const VideoOptions& video,
                          const char* part) {
    const Status made = Turn(folder / name, options, video);
    ASSERT_FALSE(made.ok()) << part;
    EXPECT_EQ(made.error().kind, ErrorKind::kUsage) << part;
    EXPECT_NE(made.error().message.find(part), std::string::npos) << made.error().message;
  };
  expect("a.avi", {700, 432}, {}, ".mp4 or .gif");
  expect("a.gif", {700, 432}, {1, 60}, "from 1 to 50 frames per second");
  expect("a.mp4", {700, 432}, {-1, 20}, "seconds");
  expect("a.mp4", {701, 432}, {1, 20}, "even sides");
  expect("a.mp4", {10, 10}, {1, 20}, "dots_per_inch");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(Palette, KeepsFewColoursExactAndManyClose) {
  const RgbImage few{3, 1, 300, {255, 255, 255, 10, 20, 30, 200, 0, 100}};
  const viz::IndexedImage exact = viz::Indexed(few, 255);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(
        exact.colors[exact.indices[i]],
        (std::array<std::uint8_t, 3>{few.rgb[3 * i], few.rgb[3 * i + 1], few.rgb[3 * i + 2]}));
  // 1024 colours in a plane of the cube on 64: cells of 32 levels, so 16 from their middle, and a
  // level for a bin's own extent.
  RgbImage many{32, 32, 300, {}};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      for (const int value : {8 * x, 8 * y, 0})
        many.rgb.push_back(static_cast<std::uint8_t>(value));
  const viz::IndexedImage close = viz::Indexed(many, 65);
  EXPECT_LE(close.colors.size(), 65u);
  for (std::size_t i = 0; i < 1024; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_LE(std::abs(close.colors[close.indices[i]][c] - many.rgb[3 * i + c]), 17);
}

}  // namespace
}  // namespace telestrain
