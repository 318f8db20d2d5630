#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "cli/program_run.h"
#include "docs/document.h"

namespace telestrain {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

const fs::path kProject = TELESTRAIN_SOURCE_DIR;

const std::vector<Document>& All() {
  static const std::vector<Document> documents = [] {
    std::vector<Document> read;
    for (const fs::path& path : DocumentPaths(kProject)) read.push_back(ReadDocument(path));
    return read;
  }();
  return documents;
}

std::string NameOf(const Document& document) {
  return fs::relative(document.path, kProject).generic_string();
}

const Document& Named(const std::string& name) {
  for (const Document& document : All())
    if (NameOf(document) == name) return document;
  throw std::runtime_error("no document " + name);
}

const std::string& Help() {
  static const std::string text = RunTelestrain({"--help"}).out;
  return text;
}

std::vector<std::string> Verbs() {
  std::vector<std::string> verbs;
  std::istringstream help(Help());
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    std::smatch verb;
    if (listed && std::regex_search(line, verb, std::regex("^  ([a-z]+) ")))
      verbs.push_back(verb[1]);
    if (line.empty()) listed = false;
    if (line.starts_with("Subcommands")) listed = true;
  }
  return verbs;
}

// Where a link of a document leads, the heading in `anchor`; empty for one to the web.
fs::path TargetOf(const Document& document, const Link& link, std::string* anchor) {
  if (link.target.find("://") != std::string::npos) return {};
  const std::size_t hash = link.target.find('#');
  *anchor = hash == std::string::npos ? "" : link.target.substr(hash + 1);
  const std::string file = link.target.substr(0, hash);
  return file.empty() ? document.path : (document.path.parent_path() / file).lexically_normal();
}

TEST(Documents, LinksLeadSomewhere) {
  int links = 0;
  for (const Document& document : All())
    for (const Link& link : document.links) {
      std::string anchor;
      const fs::path target = TargetOf(document, link, &anchor);
      if (target.empty()) continue;
      ++links;
      ASSERT_TRUE(fs::exists(target)) << NameOf(document) << ":" << link.line << " " << link.target;
      if (anchor.empty()) continue;
      const auto anchors = ReadDocument(target).anchors;
      EXPECT_NE(std::find(anchors.begin(), anchors.end(), anchor), anchors.end())
          << NameOf(document) << ":" << link.line << " " << link.target;
    }
  EXPECT_GT(links, 50);
}

TEST(Documents, AreAllReachedFromTheReadme) {
  std::set<fs::path> reached{kProject / "README.md"};
  for (std::size_t before = 0; before != reached.size();) {
    before = reached.size();
    for (const Document& document : All()) {
      if (!reached.contains(document.path)) continue;
      std::string anchor;
      for (const Link& link : document.links) reached.insert(TargetOf(document, link, &anchor));
    }
  }
  for (const Document& document : All())
    EXPECT_TRUE(reached.contains(document.path)) << NameOf(document) << " is not linked";
}

TEST(Documents, KeepTheirLength) {
  EXPECT_LE(Named("README.md").lines.size(), 150U);
  for (const std::string& verb : Verbs()) {
    const Document& page = Named("src/app/pages/" + verb + ".md");
    const auto mark = [&](const char* text) {
      const auto at = std::find_if(page.lines.begin(), page.lines.end(),
                                   [&](const std::string& l) { return l.starts_with(text); });
      return at - page.lines.begin();
    };
    const auto table = mark("<!-- options end") - mark("<!-- options:");
    ASSERT_GT(table, 0) << verb << ".md has no marks for its options";
    EXPECT_LE(page.lines.size() - static_cast<std::size_t>(table), 80U) << verb;
  }
}

TEST(VerbPages, HaveEverySection) {
  const auto verbs = Verbs();
  EXPECT_GE(verbs.size(), 16U);
  for (const std::string& verb : verbs) {
    const Document& page = Named("src/app/pages/" + verb + ".md");
    const std::set<std::string> anchors(page.anchors.begin(), page.anchors.end());
    for (const char* section :
         {"synopsis", "options", "reads-and-writes", "example", "exit-codes", "see-also"})
      EXPECT_TRUE(anchors.contains(section)) << verb << ".md has no section " << section;
    const std::string link = "(" + verb + ".md)";
    EXPECT_NE(Named("src/app/pages/README.md").text.find(link), std::string::npos) << verb;
  }
}

// Words after `--` in a text.
std::set<std::string> OptionsIn(const std::string& text) {
  static const std::regex option("--[a-z][a-z0-9-]+");
  std::set<std::string> options;
  for (std::sregex_iterator i(text.begin(), text.end(), option), end; i != end; ++i)
    options.insert(i->str());
  return options;
}

std::string HelpOf(const std::string& verb) {
  static std::map<std::string, std::string> helps;
  if (!helps.contains(verb)) {
    std::string text = RunTelestrain({verb, "--help"}).out + Help();
    if (verb == "audit")
      for (const char* part : {"verify", "replay", "show"})
        text += RunTelestrain({verb, part, "--help"}).out;
    helps[verb] = text;
  }
  return helps[verb];
}

TEST(Documents, NameOnlyOptionsThatTheVerbHas) {
  const auto verbs = Verbs();
  const std::regex call("^telestrain ([a-z]+)\\b(.*)");
  int checked = 0;
  for (const Document& document : All())
    for (const std::string& code : document.code_spans) {
      std::smatch found;
      if (!std::regex_match(code, found, call)) continue;
      ASSERT_NE(std::find(verbs.begin(), verbs.end(), found[1]), verbs.end())
          << NameOf(document) << ": " << code;
      const auto known = OptionsIn(HelpOf(found[1]));
      for (const std::string& option : OptionsIn(found[2])) {
        ++checked;
        EXPECT_TRUE(known.contains(option)) << NameOf(document) << ": " << code;
      }
    }
  EXPECT_GT(checked, 10);
}

TEST(Documents, NameEveryExitCode) {
  for (const char* name : {"README.md", "src/app/pages/README.md"})
    for (const char* code : {"0", "1", "2", "3", "4", "5", "70"})
      EXPECT_TRUE(
          std::regex_search(Named(name).text, std::regex("\\b" + std::string(code) + "\\b")))
          << name << " lacks exit code " << code;
}

// A table with a decimal fraction says where its figures come from.
TEST(Documents, SayWhereTheFiguresOfTablesComeFrom) {
  const std::regex fraction(R"([0-9]\.[0-9])");
  for (const Document& document : All())
    for (const Table& table : document.tables) {
      const bool has = std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
        return std::regex_search(row, fraction);
      });
      if (!has) continue;
      EXPECT_FALSE(table.source.empty())
          << NameOf(document) << ":" << table.line
          << ": put <!-- figures: COMMAND or SCRIPT --> before the table";
      const std::string script = table.source.substr(0, table.source.find(' '));
      if (script.find('/') == std::string::npos) continue;
      EXPECT_TRUE(fs::exists(kProject / script)) << NameOf(document) << ": " << table.source;
    }
}

}  // namespace
}  // namespace telestrain
