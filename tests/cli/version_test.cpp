// What --version tells an audit.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "cli/program_run.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<std::string> ReadVersionLines() {
  const ProgramRun run = RunTelestrain({"--version"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  std::vector<std::string> lines;
  std::istringstream stream(run.out);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

const std::vector<std::string>& VersionLines() {
  static const auto kLines = ReadVersionLines();
  return kLines;
}

// The values of the lines with this key.
std::vector<std::string> ValuesOf(const std::string& key) {
  std::vector<std::string> values;
  for (const std::string& line : VersionLines())
    if (line.starts_with(key + ": ")) values.push_back(line.substr(key.size() + 2));
  return values;
}

std::string OnlyValueOf(const std::string& key) {
  const auto values = ValuesOf(key);
  return values.size() == 1 ? values.front() : "";
}

TEST(Version, TheFirstLineIsTheVersion) {
  ASSERT_FALSE(VersionLines().empty());
  EXPECT_TRUE(
      std::regex_match(VersionLines().front(), std::regex("telestrain \\d+\\.\\d+\\.\\d+")));
}

TEST(Version, EveryOtherLineIsAKeyAndAValue) {
  const auto lines = VersionLines();
  for (std::size_t i = 1; i < lines.size(); ++i)
    EXPECT_TRUE(std::regex_match(lines[i], std::regex("[a-z-]+: [^ ].*"))) << lines[i];
}

TEST(Version, RevisionAndBuildAreNamed) {
  EXPECT_TRUE(std::regex_match(OnlyValueOf("revision"), std::regex("\\S+")));
  EXPECT_EQ(OnlyValueOf("build-type"), TELESTRAIN_BUILD_TYPE);
  EXPECT_EQ(OnlyValueOf("licence"), "Apache-2.0");
  EXPECT_FALSE(OnlyValueOf("compiler").empty());
  EXPECT_NE(OnlyValueOf("compiler-flags").find("-ffp-contract=off"), std::string::npos);
}

TEST(Version, TheBuildIsTheOneOfTheFile) {
  if (*TELESTRAIN_READELF == '\0') GTEST_SKIP() << "readelf is not installed";
  const ProgramRun run =
      RunProgram({TELESTRAIN_READELF, "--notes", "--wide", TelestrainPath().string()});
  const std::string id = OnlyValueOf("build-id");
  EXPECT_EQ(id.size(), 40u);
  EXPECT_NE(run.out.find("Build ID: " + id), std::string::npos) << run.out;
}

TEST(Version, LibrariesSayWhatIsLoaded) {
  const auto libraries = ValuesOf("library");
  EXPECT_GE(libraries.size(), 10u);
  int loaded = 0;
  for (const std::string& library : libraries) {
    const std::regex form("(\\S+) (\\S+)(, loaded (\\S+)( \\(differs\\))?)?");
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(library, parts, form)) << library;
    if (!parts[3].matched) continue;
    EXPECT_EQ(parts[2] != parts[4], parts[5].matched) << library;
    ++loaded;
  }
  EXPECT_GE(loaded, 8);
}

// Every "telestrain.NAME/VERSION" of the source.
std::set<std::string> SchemasInSource() {
  std::set<std::string> names;
  const std::regex schema("\"(telestrain\\.[a-z_]+/[0-9]+)\"");
  for (const char* folder : {"/src", "/report", "/viz"})
    for (const auto& entry :
         fs::recursive_directory_iterator(std::string(TELESTRAIN_SOURCE_DIR) + folder)) {
      const std::string name = entry.path().filename().string();
      if (!name.ends_with(".cpp") && !name.ends_with(".h")) continue;
      if (name == "version_text.cpp") continue;
      const std::string text = ReadAll(entry.path());
      for (std::sregex_iterator at(text.begin(), text.end(), schema), end; at != end; ++at)
        names.insert((*at)[1]);
    }
  names.erase("telestrain.template/1");  // is read, not written
  return names;
}

TEST(Version, EveryFormatIsNamed) {
  std::set<std::string> named;
  for (const std::string& format : ValuesOf("format"))
    if (format.starts_with("telestrain.")) named.insert(format);
  EXPECT_EQ(named, SchemasInSource());
}

TEST(Version, JsonSaysTheSame) {
  const ProgramRun run = RunTelestrain({"--version", "--json"});
  EXPECT_EQ(run.exit_code, 0);
  const Json json = Json::parse(run.out);
  EXPECT_EQ("telestrain " + json.at("telestrain").get<std::string>(), VersionLines().front());
  for (const char* key : {"revision", "build-id", "compiler", "vector-instructions"})
    EXPECT_EQ(json.at(key), OnlyValueOf(key)) << key;
  EXPECT_EQ(json.at("format"), Json(ValuesOf("format")));
  EXPECT_EQ(json.at("library").size(), ValuesOf("library").size());
}

}  // namespace
}  // namespace telestrain::testing_support
