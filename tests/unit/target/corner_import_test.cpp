#include "target/corner_import.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>

namespace telestrain {
namespace {

Session SmallSession() {
  Session session;
  session.views.resize(2);
  session.views[0].name = "A1";
  session.views[1].name = "A2";
  for (NominalView& view : session.views) view.region = {0, 0, 20, 20};
  session.target.columns = session.target.rows = 2;
  session.calibration_images = {{"c/1.png", "p1", 0}, {"c/2.png", "p1", 1}};
  return session;
}

Result<Detection> Import(const Session& session, const std::string& text) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "imported_corners.vnl";
  std::ofstream(path) << text;
  std::ostringstream out, err;
  Console console(out, err, false);
  return ImportCorners(session, path, console);
}

Result<Detection> Import(const std::string& text) { return Import(SmallSession(), text); }

std::string MessageOf(const std::string& text) {
  const auto detection = Import(text);
  return detection.ok() ? "accepted" : detection.error().message;
}

const char kBlock[] = "c/2.png#A1 1 2 0\nc/2.png#A1 3 4 1\nc/2.png#A1 - - -\nc/2.png#A1 5 6 0\n";

TEST(ImportCorners, GivesEveryImageAndViewOfTheSessionInItsOrder) {
  const auto detection = Import(std::string("# filename x y level\n") + kBlock);
  ASSERT_TRUE(detection.ok()) << detection.error().message;
  ASSERT_EQ(detection->boards.size(), 4U);
  const BoardObservation& board = detection->boards[2];
  EXPECT_EQ(board.image + "#" + board.view, "c/2.png#A1");
  EXPECT_EQ(board.rejected_because, "");
  // 0.1 px, twice as much a level up.
  EXPECT_DOUBLE_EQ(board.corners[0]->covariance_px2(0, 0), 0.01);
  EXPECT_DOUBLE_EQ(board.corners[1]->covariance_px2(1, 1), 0.04);
  EXPECT_FALSE(board.corners[2].has_value());
  for (const std::size_t i : {0U, 1U, 3U}) {
    EXPECT_TRUE(detection->boards[i].corners.empty());
    EXPECT_NE(detection->boards[i].rejected_because.find("not in "), std::string::npos);
  }
}

TEST(ImportCorners, NamesTheLineAndWhatIsKnown) {
  const std::string image = MessageOf("# filename x y level\nc/3.png#A1 - - -\n");
  EXPECT_NE(image.find("imported_corners.vnl:2: 'c/3.png' is not a calibration image"),
            std::string::npos)
      << image;
  EXPECT_NE(image.find("c/1.png, c/2.png"), std::string::npos);
  const std::string view = MessageOf("# filename x y level\n\nc/1.png#B1 - - -\n");
  EXPECT_NE(view.find("imported_corners.vnl:3: 'B1' is not a view of the session; it has A1, A2"),
            std::string::npos)
      << view;
}

TEST(ImportCorners, RefusesATableWithoutCorners) {
  EXPECT_NE(MessageOf("# filename x y level\n").find("holds no corners"), std::string::npos);
}

// A detector that was given a cut-out of the view counts from another corner.
TEST(ImportCorners, RefusesCornersOutsideTheView) {
  const std::string text =
      MessageOf("c/1.png#A2 1 2 0\nc/1.png#A2 3 25.5 0\nc/1.png#A2 - - -\nc/1.png#A2 5 6 0\n");
  EXPECT_NE(text.find("the corner (3.00, 25.50) of 'c/1.png#A2' lies outside region_px"),
            std::string::npos)
      << text;
}

TEST(ImportCorners, RefusesABlockThatComesTwice) {
  const std::string twice = std::string(kBlock) + "c/1.png#A1 - - -\n" + kBlock;
  EXPECT_NE(MessageOf(twice).find("'c/2.png#A1' has two blocks"), std::string::npos);
}

// A block of 3 x 2 corners, 4 px apart, whose line i is corner `order[i]` of the right order.
std::string MessageOfOrder(const std::array<int, 6>& order) {
  Session session = SmallSession();
  session.target.columns = 3;
  session.target.boards = {{"", Eigen::Vector3d::Zero(), 0}};
  std::string text = "# filename x y level\n";
  for (const int corner : order)
    text += "c/1.png#A1 " + std::to_string(4 + 4 * (corner % 3)) + " " +
            std::to_string(4 + 4 * (corner / 3)) + " 0\n";
  const auto detection = Import(session, text);
  return detection.ok() ? "accepted" : detection.error().message;
}

TEST(ImportCorners, NamesTheOrderThatABlockRunsIn) {
  EXPECT_EQ(MessageOfOrder({0, 1, 2, 3, 4, 5}), "accepted");
  const auto expect = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find("run " + part + "; write"), std::string::npos) << message;
  };
  expect(MessageOfOrder({2, 1, 0, 5, 4, 3}), "against the target's x");
  expect(MessageOfOrder({3, 4, 5, 0, 1, 2}), "against the target's y");
  expect(MessageOfOrder({0, 3, 1, 4, 2, 5}), "down the columns first (y fastest)");
  expect(MessageOfOrder({5, 4, 3, 2, 1, 0}), "against the target's x, against the target's y");
}

}  // namespace
}  // namespace telestrain
