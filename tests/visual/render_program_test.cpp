#include <gtest/gtest.h>

#include "base/files.h"
#include "cli/program_run.h"
#include "visual/results_fixture.h"
#include "viz/egl_context.h"

namespace telestrain {
namespace {

using testing_support::ProgramRun;
using testing_support::RunTelestrain;
using testing_support::Surroundings;

std::string Bytes(const std::filesystem::path& path) {
  const auto bytes = ReadFile(path, kMostResultBytes);
  EXPECT_TRUE(bytes.ok()) << path;
  return bytes.ok() ? *bytes : std::string();
}

// The fixture's results, written once.
const std::filesystem::path& Results() {
  static const std::filesystem::path folder = [] {
    const auto made = visual_test::FreshFolder("RenderProgram");
    visual_test::WriteResults(made);
    return made;
  }();
  return folder;
}

// One view in a process of its own.
std::string Rendered(const std::string& name, const Surroundings& where,
                     const std::vector<std::string>& more = {}) {
  const auto file = visual_test::FreshFolder("RenderProgram_" + name) / "picture.png";
  std::vector<std::string> words{"render", Results().string(), "--size", "1200x740",
                                 "--out",  file.string()};
  words.insert(words.end(), more.begin(), more.end());
  const ProgramRun run = RunTelestrain(words, where);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return Bytes(file);
}

TEST(RenderProgram, GivesTheSameBytesWithOneThreadOrTwo) {
  const std::vector<std::string> view{"--view", "array"};
  const auto threads = [](const char* count) {
    return Surroundings{.environment = {{"LP_NUM_THREADS", count}, {"DISPLAY", std::nullopt}}};
  };
  const std::string two = Rendered("Two", threads("2"), view);
  EXPECT_FALSE(two.empty());
  EXPECT_TRUE(Rendered("One", threads("1"), view) == two);
  EXPECT_TRUE(Rendered("None", threads("0"), view) == two);
  EXPECT_TRUE(Rendered("OneProcessor", {.environment = {}, .one_processor = true}, view) == two);
}

TEST(RenderProgram, GivesTheSameBytesFromBothBackends) {
  if (!viz::HasEgl()) GTEST_SKIP() << "libEGL.so.1 is not installed";
  const std::vector<std::string> view{"--view", "pipe_strain", "--backend"};
  auto osmesa = view, egl = view;
  osmesa.emplace_back("osmesa");
  egl.emplace_back("egl");
  EXPECT_TRUE(Rendered("Osmesa", {}, osmesa) == Rendered("Egl", {}, egl));
}

TEST(RenderProgram, SaysWhatIsWrongWithTheCommandLine) {
  const std::pair<std::vector<std::string>, const char*> wrong[] = {
      {{"--size", "12"}, "--size takes WIDTHxHEIGHT"},
      {{"--size", "20000x1000"}, "width_px from 1 to 16384 is wanted, found 20000"},
      {{"--dpi", "9"}, "dots_per_inch from 72 to 2448"},
      {{"--view", "aray"}, "nearest is 'array'"},
      {{"--state", "1"}, "add --view pipe_strain"},
      {{"--view", "array", "--state", "1", "--quantity", "sigma_um"}, "for: pipe_strain"},
      {{"--view", "contact_sheet"}, "there is no view 'contact_sheet'"},
      {{"--view", "pipe_strain", "--state", "99"}, "there is no state '99'"},
      {{"--view", "pipe_strain", "--quantity", "axial"}, "there is no quantity 'axial'"},
      {{"--range", "-1e308", "1e308"}, "from -1e12 to 1e12 is wanted"},
      {{"--seconds", "3"}, "add --turntable or --states"},
      {{"--turntable", "a.gif", "--range", "0", "1"}, "--range"},
      {{"--states", "a.gif", "--state", "1"}, "--state"},
      {{"--range", "2", "1"}, "a low end below the high one"},
      {{"--backend", "metal"}, "osmesa"}};
  for (const auto& [words, part] : wrong) {
    std::vector<std::string> all{"render", Results().string()};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramRun run = RunTelestrain(all);
    EXPECT_EQ(run.exit_code, 2) << words.front();
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(Results() / "pictures"));
}

}  // namespace
}  // namespace telestrain
