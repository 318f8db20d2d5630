#include "base/console.h"

#include <gtest/gtest.h>

#include <sstream>

namespace telestrain {
namespace {

TEST(ConsoleTest, ResultsAndSideInformationHaveTheirOwnStreams) {
  std::ostringstream out, err;
  Console console(out, err, false);
  console.Say("result");
  console.Note("note");
  console.Warn("careful");
  EXPECT_EQ(out.str(), "result\n");
  EXPECT_EQ(err.str(), "note\nwarning: careful\n");
}

TEST(ConsoleTest, NoBarWithoutATerminal) {
  std::ostringstream out, err;
  Console console(out, err, false);
  console.Progress("detect", 1, 2);
  EXPECT_EQ(out.str() + err.str(), "");
}

TEST(ConsoleTest, BarIsClearedBeforeALineAndAtTheEnd) {
  std::ostringstream out, err;
  Console console(out, err, true);
  console.Progress("detect", 1, 2);
  EXPECT_NE(err.str().find("detect [################----------------] 1/2"), std::string::npos);
  console.Say("result");
  EXPECT_EQ(out.str(), "result\n");
  EXPECT_TRUE(err.str().ends_with("\r\x1b[K"));
  console.Progress("detect", 2, 2);
  EXPECT_TRUE(err.str().ends_with("2/2\r\x1b[K"));
}

TEST(ConsoleTest, BarTakesCountsOutsideItsRange) {
  std::ostringstream out, err;
  Console console(out, err, true);
  console.Progress("detect", 0, 0);
  EXPECT_EQ(err.str(), "");
  console.Progress("detect", 3, 2);
  console.Progress("detect", -1, 2);
  EXPECT_NE(err.str().find("3/2"), std::string::npos);
}

}  // namespace
}  // namespace telestrain
