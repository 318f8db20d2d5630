// The same input gives the same bytes, whatever surrounds the program; nothing else is touched.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "correlation/kernels.h"
#include "correlation/subset_correlation.h"
#include "integration/small_run.h"
#include "unit/base/scratch_folder.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

using correlation::VectorLevel;

class RunBytes : public SmallRun {
 protected:
  const fs::path& Scratch() const { return scratch_.path(); }

 private:
  ScratchFolder scratch_{"telestrain_run_bytes_"};
};

// Without session.path, which says where the session lies and nothing else.
std::vector<std::string> DifferingResults(const fs::path& a, const fs::path& b) {
  std::vector<std::string> names = DifferingFiles(a, b);
  std::erase(names, "session.path");
  return names;
}

// What a run of the program must not depend on: German with a decimal comma, made for the test
// below `folder` when localedef (Debian package locales) is there, and a time zone of no country.
Surroundings FarAway(const fs::path& folder) {
  fs::create_directories(folder / "home");
  fs::create_directories(folder / "locales");
  RunProgram({"/usr/bin/env", "localedef", "--no-archive", "-i", "de_DE", "-f", "UTF-8",
              (folder / "locales/de_DE.UTF-8").string()});
  return {folder,
          {{"HOME", (folder / "home").string()},
           {"TZ", "ABC-12:34"},
           {"LOCPATH", (folder / "locales").string()},
           {"LANG", "de_DE.UTF-8"},
           {"LC_ALL", "de_DE.UTF-8"},
           {"DISPLAY", std::nullopt},
           {"WAYLAND_DISPLAY", std::nullopt}},
          true};
}

// A program that asks for its language and its time does differ where the next test runs ours.
TEST_F(RunBytes, OtherProgramsDoDependOnLanguageAndTimeZone) {
  const Surroundings where = FarAway(Scratch());
  EXPECT_EQ(RunProgram({"/usr/bin/env", "date", "+%z"}, where).out, "+1234\n");
  if (!fs::exists(Scratch() / "locales/de_DE.UTF-8"))
    GTEST_SKIP() << "no German: the Debian package locales is not installed";
  EXPECT_EQ(RunProgram({"/usr/bin/env", "printf", "%.1f", "1.5"}, where).out, "1,5");
}

TEST_F(RunBytes, DoNotDependOnPlaceTimeZoneLanguageDisplayOrProcessors) {
  const fs::path elsewhere = Scratch() / "else where";
  const Surroundings where = FarAway(elsewhere);
  fs::copy(SmallSession(), elsewhere / "my session", fs::copy_options::recursive);
  const ProgramRun run =
      RunTelestrain({"--threads", "1", "run", "my session", "--out", "my results"}, where);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(DifferingResults(Results(), elsewhere / "my results"), std::vector<std::string>());
}

// A run on so many threads with these instructions, none: the processor's best. Through the
// options and, for the second of them, the environment.
void RunOn(const std::string& threads, const std::string& level, const fs::path& out) {
  Surroundings where;
  if (!level.empty()) where.environment["TELESTRAIN_VECTOR"] = level;
  const ProgramRun run = RunTelestrain(
      {"--threads", threads, "run", SmallSession().string(), "--out", out.string()}, where);
  ASSERT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(RunBytes, DoNotDependOnThreads) {
  for (const std::string threads : {"3", "8"}) {
    const fs::path out = Scratch() / threads;
    RunOn(threads, "", out);
    EXPECT_EQ(DifferingResults(Results(), out), std::vector<std::string>()) << threads;
  }
}

TEST_F(RunBytes, DoNotDependOnTheProcessorsVectorsWhereTheyFuse) {
  const VectorLevel best = correlation::BestVectorLevel();
  if (best != VectorLevel::kAvx512)
    GTEST_SKIP() << "this processor has no AVX-512; its best is " << correlation::NameOf(best);
  RunOn("2", "avx2", Scratch() / "avx2");
  EXPECT_EQ(DifferingResults(Results(), Scratch() / "avx2"), std::vector<std::string>());
}

// Whether the matching of the pipe's subsets decides about a file.
bool ComesFromMatching(const std::string& name) {
  for (const char* begin :
       {"pipe_", "strain", "pictures/", "results.json", "dcc.xml", "report.pdf", "audit.jsonl"})
    if (name.starts_with(begin)) return true;
  return false;
}

// The numbers of an array in a .vtp file.
std::vector<double> ArrayOf(const fs::path& file, const std::string& name) {
  const std::string text = ReadAll(file);
  const std::size_t begin = text.find('>', text.find("Name=\"" + name + "\"")) + 1;
  std::istringstream numbers(text.substr(begin, text.find('<', begin) - begin));
  return {std::istream_iterator<double>(numbers), {}};
}

void ExpectNearEach(const std::vector<double>& a, const std::vector<double>& b, double most) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  EXPECT_LE(largest, most);
}

// Without fused operations the last digits differ, and with them where the matching stops: when a
// step is below convergence_px. Steps at least halve, so both end within that of the optimum, and
// two of them within twice of it from each other. Two views 60 degrees apart turn a pixel into
// 1 / sin(30 degrees) pixels across them at the most.
TEST_F(RunBytes, OfPlainOperationsDifferByLessThanTheMatchingsConvergence) {
  const fs::path two = Scratch() / "two", eight = Scratch() / "eight";
  RunOn("2", "plain", two);
  RunOn("8", "plain", eight);
  EXPECT_EQ(DifferingResults(two, eight), std::vector<std::string>());
  for (const std::string& name : DifferingResults(Results(), two))
    EXPECT_TRUE(ComesFromMatching(name)) << name;
  const double pixel_mm =
      ResultJson("calibration.json").at("lens").at("object_side_um_per_px").get<double>() / 1000;
  const double along_mm = 2 * CorrelationOptions().convergence_px * pixel_mm;
  for (const char* name : {"pipe_000.vtp", "pipe_001.vtp", "pipe_002.vtp"})
    for (const char* array : {"position_in_array_mm", "displacement_mm"})
      ExpectNearEach(ArrayOf(Results() / name, array), ArrayOf(two / name, array), 2 * along_mm);
  const auto strain = ResultJson("strain.json");
  const auto plain = nlohmann::json::parse(ReadAll(two / "strain.json"));
  const double most_microstrain = 1e6 * 2 * along_mm / strain.at("base_length_mm").get<double>();
  for (std::size_t i = 0; i < strain.at("states").size(); ++i)
    EXPECT_NEAR(strain.at("states").at(i).at("axial_microstrain").get<double>(),
                plain.at("states").at(i).at("axial_microstrain").get<double>(), most_microstrain);
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
  EXPECT_TRUE(fs::is_empty(Folder() / "home"));
  EXPECT_TRUE(fs::is_empty(Folder() / "work"));
}

TEST_F(RunBytes, NeitherTimesNorPlacesStandInTheResults) {
  for (const auto& [name, bytes] : BytesBelow(Results())) {
    if (name == "session.path") continue;  // where the session lies
    for (const std::string& text : {Folder().string(), SmallSession().parent_path().string()})
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
