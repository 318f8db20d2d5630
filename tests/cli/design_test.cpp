#include <gtest/gtest.h>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Design, ThePapersArrayHolds) {
  const ProgramRun run = RunTelestrain({"design"});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(run.out.starts_with("rig: The paper's array;")) << run.out;
  EXPECT_TRUE(Holds(run.out, "33.402  >=  31.300")) << run.out;
  EXPECT_FALSE(Holds(run.out, "FAILS")) << run.out;
}

TEST(Design, MirrorsThatAreTooSmallAreOutsideTheLimits) {
  const ProgramRun run = RunTelestrain({"design", "--mirror-margin-mm", "-1"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_TRUE(Holds(run.out, "FAILS")) << run.out;
  const ProgramRun sized =
      RunTelestrain({"design", "--mirror-size-mm", "30", "30", "30", "30", "5", "3"});
  EXPECT_EQ(sized.exit_code, 1) << sized.err;
}

TEST(Design, ValuesOutsideTheirRangeAreWrongUsage) {
  for (const std::string value : {"0", "0.9", "wide"}) {
    const ProgramRun run = RunTelestrain({"design", "--numerical-aperture", value});
    EXPECT_EQ(run.exit_code, 2) << value << run.out;
    EXPECT_TRUE(Holds(run.err, "--numerical-aperture")) << run.err;
  }
}

using DesignOfSession = SessionCopy;

TEST_F(DesignOfSession, NeedsMirrorsAndSaysHowToGiveThem) {
  const ProgramRun run = RunTelestrain({"design", session().string(), "--out", results().string()});
  EXPECT_EQ(run.exit_code, 3) << run.out;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(Holds(run.err, "mirrors = [{")) << run.err;
  EXPECT_FALSE(fs::exists(results()));
}

// The paper's mirrors of one view, to be put behind its name; sx is the group's side, sy the
// view's.
std::string Mirrors(const std::string& name, int sx, int sy) {
  const auto point = [](double x, double y, const std::string& normal) {
    return "{ point_mm = [" + std::to_string(x) + ", " + std::to_string(y) +
           ", 40.0], normal = " + normal + " }";
  };
  const auto sign = [](int side) { return std::string(side < 0 ? "-" : ""); };
  return name + "\nmirrors = [" +
         point(2.1384 * sx, 2.8512 * sy, "[" + sign(sx) + "0.70710678, 0.0, 0.70710678]") + ", " +
         point(13.85 * sx, 2.8512 * sy,
               "[" + sign(-sx) + "0.70710678, " + sign(sy) + "0.70710678, 0.0]") +
         ", " + point(13.85 * sx, 23.094011 * sy, "[0.0, " + sign(-sy) + "0.8660254, -0.5]") + "]";
}

TEST_F(DesignOfSession, IsThatOfThePaperWhenItsMirrorsAreThePapers) {
  for (const int sx : {-1, 1})
    for (const int sy : {-1, 1}) {
      const std::string name =
          std::string("name = \"") + (sx < 0 ? "A" : "B") + (sy < 0 ? "1\"" : "2\"");
      Replace("session.toml", name, Mirrors(name, sx, sy));
    }
  Replace("session.toml", "[target]",
          "[camera]\nposition_mm = [0.0, 0.0, 80.0]\naxis = [0.0, 0.0, -1.0]\n"
          "image_x = [0.0, 1.0, 0.0]\nimage_y = [1.0, 0.0, 0.0]\n\n[target]");
  const ProgramRun run =
      RunTelestrain({"design", (session() / "session.toml").string(), "--out", results().string()});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  // The session's pixels are four times as large and change nothing in mm.
  const std::string paper = RunTelestrain({"design"}).out;
  const std::string checks = paper.substr(paper.find("check "));
  EXPECT_TRUE(Holds(run.out, checks)) << run.out << "\nwanted\n" << checks;
  EXPECT_TRUE(Holds(ReadAll(results() / "design.json"), "\"telestrain.design/1\""));
  EXPECT_TRUE(ReadAll(results() / "rays.png").starts_with("\x89PNG"));
}

}  // namespace
}  // namespace telestrain::testing_support
