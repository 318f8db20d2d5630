#include "viz/video.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
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
  const auto bytes = ReadFile(path, kMostResultBytes);
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
  const auto difference = [&](std::size_t a, std::size_t b) {
    return cv::norm(frames[a], frames[b], cv::NORM_L1) / static_cast<double>(frames[0].total());
  };
  for (std::size_t i = 0; i < states; ++i) {
    // The two frames of a state are one picture, coded twice: less than a level per channel.
    EXPECT_LT(difference(2 * i, 2 * i + 1), 3) << i;
    // The next state's pipe has other colours, from 0 to 800 microstrain.
    if (i + 1 == states) break;
    EXPECT_GT(difference(2 * i + 1, 2 * i + 2), 3 * difference(2 * i, 2 * i + 1)) << i;
  }
}

// Of a GIF's frames, in hundredths of a second (GIF89a, 23: graphic control extension).
std::vector<int> Delays(const std::string& gif) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(gif.at(at)); };
  const auto colors = [&](std::size_t at) {
    return byte(at) & 0x80 ? 3u << ((byte(at) & 7) + 1) : 0u;
  };
  std::vector<int> delays;
  std::size_t at = 13 + colors(10);
  while (byte(at) != 0x3b) {
    const bool is_extension = byte(at) == 0x21;
    if (is_extension && byte(at + 1) == 0xf9) delays.push_back(byte(at + 4) + 256 * byte(at + 5));
    at += is_extension ? 2 : 11 + colors(at + 9);
    while (byte(at) != 0) at += byte(at) + 1u;  // blocks of data
    ++at;
  }
  return delays;
}

TEST(Video, AGifShowsEveryStateForItsTime) {
  const auto file = visual_test::FreshFolder("VideoGifStates") / "cycle.gif";
  std::ostringstream out, err;
  Console console(out, err, false);
  // Three states in 2.5 s of 4 frames per second: 10 frames, of which 3, 3 and 4.
  const Status made = RenderStates(Results(), {800, 494}, {2.5, 4}, file, console);
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_EQ(Delays(Bytes(file)), (std::vector<int>{75, 75, 100}));
}

// A pipe_NNN.vtp of one quad: soon read.
constexpr const char* kOneQuad = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="4" NumberOfPolys="1"><PointData>
<DataArray type="Float64" Name="displacement_mm" NumberOfComponents="3" format="ascii">
0 0 0 0 0 0 0 0 0 0 0 0</DataArray>
<DataArray type="Float64" Name="axial_microstrain" format="ascii">1 2 3 4</DataArray>
<DataArray type="Float64" Name="sigma_um" format="ascii">1 1 1 1</DataArray>
<DataArray type="Int32" Name="group" format="ascii">0 0 0 0</DataArray>
</PointData><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">
-14 0 0 -13 0 0 -13 1 0 -14 1 0</DataArray></Points><Polys>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
</Polys></Piece></PolyData></VTKFile>
)";

TEST(Video, ManyStatesShareTheMostSeconds) {
  const auto folder = visual_test::FreshFolder("VideoManyStates");
  visual_test::WriteResults(folder);
  ASSERT_TRUE(WriteFileAtomically(folder / "pipe_000.vtp", kOneQuad).ok());
  auto strain = nlohmann::json::parse(Bytes(folder / "strain.json"));
  // 607.5 s of 1.5 s each.
  strain["states"] = nlohmann::json(405, nlohmann::json(strain["states"][0]));
  ASSERT_TRUE(WriteFileAtomically(folder / "strain.json", strain.dump()).ok());
  std::ostringstream out, err;
  Console console(out, err, false);
  // Odd sides are refused when the file is opened: after the times, before the drawing.
  const Status made = RenderStates(folder, {701, 434}, {}, folder / "a.mp4", console);
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("even sides"), std::string::npos) << made.error().message;
}

// A frame of one colour.
RgbImage Plain(std::uint8_t level) {
  return {64, 64, 300, std::vector<std::uint8_t>(3 * 64 * 64, level)};
}

TEST(Video, TwoFilmsOfOneNameDoNotMix) {
  const auto folder = visual_test::FreshFolder("VideoOneName");
  const auto path = folder / "film.mp4";
  auto dark = viz::OpenMp4(path, 64, 64, 5), light = viz::OpenMp4(path, 64, 64, 5);
  ASSERT_TRUE(dark.ok() && light.ok());
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE((*dark)->Add(Plain(50)).ok());
    ASSERT_TRUE((*light)->Add(Plain(200)).ok());
  }
  for (const auto& [film, level] : {std::pair{&*light, 200}, std::pair{&*dark, 50}}) {
    ASSERT_TRUE((*film)->Close().ok());
    const auto frames = Decoded(path);
    ASSERT_EQ(frames.size(), 10u);
    // Limited-range luma has 219 steps for 255 levels: 2 levels of rounding there and back.
    for (const cv::Mat& frame : frames) EXPECT_NEAR(cv::mean(frame)[1], level, 2);
  }
  dark->reset();
  light->reset();
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(Video, TakesARelativeNameWithAColon) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(visual_test::FreshFolder("VideoColon"));
  auto film = viz::OpenMp4("run:2.mp4", 64, 64, 5);
  EXPECT_TRUE(film.ok());
  if (film.ok()) {
    EXPECT_TRUE((*film)->Add(Plain(99)).ok());
    EXPECT_TRUE((*film)->Close().ok());
  }
  EXPECT_TRUE(std::filesystem::exists("run:2.mp4"));
  std::filesystem::current_path(before);
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
  expect("a.mp4", {700, 432}, {601, 20}, "to 600 seconds are wanted, found 601");
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
