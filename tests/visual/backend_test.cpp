#include <gtest/gtest.h>

#include <thread>

#include "visual/results_fixture.h"
#include "viz/egl_context.h"
#include "viz/pictures.h"
#include "viz/scene_from_results.h"
#include "viz/window_keeper.h"

extern "C" void* OSMesaGetCurrentContext();

namespace telestrain::viz {
namespace {

const RenderOptions kSmall{1200, 740};

const Scene& FixtureScene() {
  static const Scene scene = [] {
    const auto folder = visual_test::FreshFolder("Backend");
    visual_test::WriteResults(folder);
    return *SceneFromResults(folder);
  }();
  return scene;
}

std::vector<std::uint8_t> Pixels(const Result<Picture>& picture) {
  EXPECT_TRUE(picture.ok()) << (picture.ok() ? "" : picture.error().message);
  return picture.ok() ? picture->image.rgb : std::vector<std::uint8_t>();
}

TEST(Backends, GiveTheSamePixels) {
  if (!HasEgl()) GTEST_SKIP() << "libEGL.so.1 is not installed";
  RenderOptions egl = kSmall;
  egl.backend = GlBackend::kEgl;
  const auto osmesa_pixels = Pixels(DrawArray(FixtureScene(), kSmall));
  EXPECT_TRUE(Pixels(DrawArray(FixtureScene(), egl)) == osmesa_pixels);
  // One after the other in one process, whichever was first.
  EXPECT_TRUE(Pixels(DrawArray(FixtureScene(), kSmall)) == osmesa_pixels);
}

TEST(Backends, ShareAProcessWithKeptWindows) {
  if (!HasEgl()) GTEST_SKIP() << "libEGL.so.1 is not installed";
  RenderOptions egl = kSmall;
  egl.backend = GlBackend::kEgl;
  const auto pixels = Pixels(DrawTargets(FixtureScene(), kSmall));
  const WindowKeeper keeper;
  for (const RenderOptions& options : {kSmall, egl, kSmall, egl})
    EXPECT_TRUE(Pixels(DrawTargets(FixtureScene(), options)) == pixels);
}

// A window that drew something else before gives what a new one gives, at any size.
TEST(WindowKeeper, ChangesNoPixel) {
  const RenderOptions large{1500, 900};
  const auto array = Pixels(DrawArray(FixtureScene(), kSmall));
  const auto strain = Pixels(DrawPipeStrain(FixtureScene(), large));
  const WindowKeeper keeper;
  for (int repeat = 0; repeat < 2; ++repeat) {
    EXPECT_TRUE(Pixels(DrawArray(FixtureScene(), kSmall)) == array) << repeat;
    EXPECT_TRUE(Pixels(DrawPipeStrain(FixtureScene(), large)) == strain) << repeat;
  }
}

// A context that stays with a thread is dangling there when another thread ends it.
TEST(WindowKeeper, LeavesNoContextWithTheThreadThatDrew) {
  const WindowKeeper keeper;
  EXPECT_TRUE(DrawPipeStrain(FixtureScene(), kSmall).ok());
  EXPECT_EQ(OSMesaGetCurrentContext(), nullptr);
  const RenderOptions narrow{1200, 740, 400};  // no room for all texts
  EXPECT_FALSE(DrawArray(FixtureScene(), narrow).ok());
  EXPECT_EQ(OSMesaGetCurrentContext(), nullptr);
}

TEST(WindowKeeper, ServesThreadsInTurn) {
  const auto pixels = Pixels(DrawTargets(FixtureScene(), kSmall));
  const WindowKeeper keeper;
  std::vector<std::vector<std::uint8_t>> drawn(4);
  std::vector<std::thread> threads;
  for (auto& one : drawn)
    threads.emplace_back([&one] { one = Pixels(DrawTargets(FixtureScene(), kSmall)); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& one : drawn) EXPECT_TRUE(one == pixels);
}

}  // namespace
}  // namespace telestrain::viz
