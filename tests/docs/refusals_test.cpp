#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "docs/document.h"
#include "docs/source_messages.h"

namespace telestrain {
namespace {

using namespace testing_support;

const std::filesystem::path kProject = TELESTRAIN_SOURCE_DIR;

// What an operator's recording can run into; `design`, `simulate`, `study` and `correlate` have
// pages of their own.
const std::vector<std::string> kModules = {"src/base",       "src/app",         "src/session",
                                           "src/target",     "src/calibration", "src/measurement",
                                           "src/diagnostics"};

// The messages of the first column of every table: one or several code spans.
std::vector<std::string> KnownMessages() {
  static const std::regex span("`([^`]+)`");
  std::vector<std::string> messages;
  for (const Table& table : ReadDocument(kProject / "src/session/REFUSALS.md").tables)
    for (const std::string& row : table.rows) {
      const std::string cell = row.substr(1, row.find(" | ") - 1);
      for (std::sregex_iterator i(cell.begin(), cell.end(), span), end; i != end; ++i)
        messages.push_back((*i)[1]);
    }
  return messages;
}

std::vector<SourceMessage> AllMessages() {
  std::vector<SourceMessage> all;
  for (const std::string& module : kModules) {
    const auto some = MessagesOfModule(kProject, module);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

TEST(Refusals, EveryMessageOfTheSourcesIsExplained) {
  const auto known = KnownMessages();
  const auto messages = AllMessages();
  ASSERT_GT(messages.size(), 150U) << "the scanner finds no messages any more";
  for (const SourceMessage& message : messages) {
    if (std::regex_match(message.text, std::regex("[…:; \x80-\xff]*"))) continue;
    EXPECT_TRUE(std::any_of(known.begin(), known.end(),
                            [&](const std::string& k) { return IsIn(k, message.text); }))
        << message.place << ": \"" << message.text << "\" is not in src/session/REFUSALS.md";
  }
}

TEST(Refusals, NoMessageIsExplainedThatTheSourcesLack) {
  const auto messages = AllMessages();
  for (const std::string& known : KnownMessages()) {
    EXPECT_GE(known.size(), 12U) << known << " is too short to tell messages apart";
    EXPECT_TRUE(std::any_of(messages.begin(), messages.end(),
                            [&](const SourceMessage& m) { return IsIn(known, m.text); }))
        << "src/session/REFUSALS.md explains \"" << known << "\", which no source says";
  }
}

TEST(SourceMessages, JoinsLiteralsAndMarksWhatIsKnownAtRunTime) {
  const auto found = MessagesOf(
      "x;\nreturn BadInput(path.string() + \": has \" +\n  F(\"x\") + \" views\");\n"
      "return Error{ErrorKind::kUsage, \"say \\\"why\\\"\"};",
      "a.cpp");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].place, "a.cpp:2");
  EXPECT_EQ(found[0].text, "…: has …x… views");
  EXPECT_EQ(found[1].text, "…say \"why\"");
  EXPECT_TRUE(IsIn("has … views", found[0].text));
  EXPECT_FALSE(IsIn("views … has", found[0].text));
}

}  // namespace
}  // namespace telestrain
