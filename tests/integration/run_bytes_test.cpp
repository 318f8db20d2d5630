// The same input gives the same bytes, whatever surrounds the program; nothing else is touched.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "integration/small_run.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

class RunBytes : public SmallRun {};

// Without session.path, which says where the session lies and nothing else.
std::vector<std::string> DifferingResults(const fs::path& a, const fs::path& b) {
  std::vector<std::string> names = DifferingFiles(a, b);
  std::erase(names, "session.path");
  return names;
}

TEST_F(RunBytes, DoNotDependOnPlaceTimeZoneLanguageDisplayOrProcessors) {
  const fs::path elsewhere = Scratch() / "else where";
  fs::create_directories(elsewhere / "home");
  fs::copy(SmallSession(), elsewhere / "my session", fs::copy_options::recursive);
  const Surroundings where{elsewhere,
                           {{"HOME", (elsewhere / "home").string()},
                            {"TZ", "Pacific/Auckland"},
                            {"LANG", "de_DE.UTF-8"},
                            {"LC_ALL", "de_DE.UTF-8"},
                            {"DISPLAY", std::nullopt},
                            {"WAYLAND_DISPLAY", std::nullopt}},
                           true};
  const ProgramRun run = RunTelestrain({"run", "my session", "--out", "my results"}, where);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(DifferingResults(Results(), elsewhere / "my results"), std::vector<std::string>());
}

TEST_F(RunBytes, AreThoseOfTheStepsOneByOne) {
  const std::string out = (Scratch() / "steps").string();
  for (const char* verb : {"detect", "calibrate", "verify", "measure"}) {
    const ProgramRun run = RunTelestrain({verb, SmallSession().string(), "--out", out});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  for (const char* verb : {"diagnose", "render", "report"}) {
    const ProgramRun run = RunTelestrain({verb, out});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  // `render` draws the whole set, `run` what the report shows of it. The audit trail tells so, and
  // the order of the steps; the report carries it.
  for (const std::string& file : DifferingResults(Results(), out)) {
    if (file == "audit.jsonl" || file == "report.pdf") continue;
    EXPECT_TRUE(file.starts_with("pictures/")) << file;
    EXPECT_FALSE(fs::exists(Results() / file)) << file;
  }
}

TEST_F(RunBytes, NothingIsWrittenOutsideTheResultsFolder) {
  EXPECT_TRUE(fs::is_empty(Scratch() / "home"));
  EXPECT_TRUE(fs::is_empty(Scratch() / "work"));
}

TEST_F(RunBytes, NeitherTimesNorPlacesStandInTheResults) {
  for (const auto& [name, bytes] : BytesBelow(Results())) {
    if (name == "session.path") continue;  // where the session lies
    for (const std::string& text : {Scratch().string(), SmallSession().parent_path().string()})
      EXPECT_EQ(bytes.find(text), std::string::npos) << name << " names " << text;
  }
}

// The words of the line of data/README.md that made the session, without the program.
std::vector<std::string> CommandOfTheReadme() {
  const std::string text = ReadAll(SmallSession().parent_path() / "README.md");
  const std::size_t start = text.find("\ntelestrain simulate ") + 1;
  std::istringstream line(text.substr(start, text.find('\n', start) - start));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  words.erase(words.begin());
  return words;
}

// Numbers may differ in their last digits: another processor, another library's sine.
void ExpectNear(const nlohmann::json& a, const nlohmann::json& b, const std::string& where) {
  ASSERT_EQ(a.is_number(), b.is_number()) << where;
  if (a.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    EXPECT_LE(std::abs(x - y), 1e-9 * std::max(1.0, std::abs(x))) << where;
    return;
  }
  if (!a.is_structured()) {
    EXPECT_EQ(a, b) << where;
    return;
  }
  const auto flat = a.flatten(), other = b.flatten();
  ASSERT_EQ(flat.size(), other.size()) << where;
  for (const auto& [key, value] : flat.items()) {
    ASSERT_TRUE(other.contains(key)) << key;
    if (value.is_primitive()) ExpectNear(value, other.at(key), key);
  }
}

TEST_F(RunBytes, TheCommittedSessionIsWhatItsCommandMakes) {
  const fs::path folder = Scratch() / "again";
  fs::create_directories(folder);
  const ProgramRun run = RunTelestrain(CommandOfTheReadme(), {folder, {}});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(DifferingFiles(SmallSession(), folder / "small_session"), std::vector<std::string>());
  ExpectNear(Truth(), nlohmann::json::parse(ReadAll(folder / "small_session-truth.json")), "");
}

}  // namespace
}  // namespace telestrain::testing_support
