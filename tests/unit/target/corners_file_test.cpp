#include "target/corners_file.h"

#include <gtest/gtest.h>

namespace telestrain {
namespace {

std::vector<BoardObservation> Boards() {
  const auto at = [](double x, double y) {
    return std::optional(ImagePoint{{x, y}, Eigen::Matrix2d::Identity()});
  };
  return {{"calib/image 1.png", "A1", {at(0.1, 2.5), std::nullopt, at(1e-7, 1234.56789)}, {}, 0},
          {"calib/image 1.png", "B2", {}, "no board in the view", 0},
          {"calib/2.png", "A1", {at(1, 2), at(3, 4), at(5, 6)}, {}, 0}};
}

TEST(CornersFile, WritesTheFormatOfTheSessionDocument) {
  EXPECT_EQ(CornersVnlText({Boards()[2], Boards()[1]}),
            "# filename x y level\n"
            "calib/2.png#A1 1 2 0\ncalib/2.png#A1 3 4 0\ncalib/2.png#A1 5 6 0\n"
            "calib/image 1.png#B2 - - -\n");
}

TEST(CornersFile, ReadsBackWhatItWrote) {
  const auto written = Boards();
  const auto read = ParseCornersVnl("c.vnl", CornersVnlText(written), 3);
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_EQ(read->size(), written.size());
  for (std::size_t b = 0; b < written.size(); ++b) {
    EXPECT_EQ((*read)[b].image, written[b].image);
    EXPECT_EQ((*read)[b].view, written[b].view);
    EXPECT_EQ((*read)[b].rejected_because.empty(), written[b].rejected_because.empty());
    ASSERT_EQ((*read)[b].corners.size(), written[b].corners.size());
    for (std::size_t i = 0; i < written[b].corners.size(); ++i) {
      ASSERT_EQ((*read)[b].corners[i].has_value(), written[b].corners[i].has_value());
      if (written[b].corners[i]) {
        EXPECT_EQ((*read)[b].corners[i]->pixel, written[b].corners[i]->pixel);
      }
    }
  }
}

TEST(CornersFile, NamesTheLineOfAMistake) {
  const auto message = [](const std::string& text) {
    const auto read = ParseCornersVnl("c.vnl", "# filename x y level\n" + text, 3);
    return read.ok() ? std::string("accepted") : read.error().message;
  };
  EXPECT_NE(message("a#A1 1 2\n").find("c.vnl:2: "), std::string::npos);
  EXPECT_NE(message("a#A1 1 2 0\na#A1 1 two 0\n").find("c.vnl:3: 'two' is not a number"),
            std::string::npos);
  EXPECT_NE(message("a#A1 1 2 x\n").find("level 'x'"), std::string::npos);
  EXPECT_NE(message("a 1 2 0\n").find("does not name a view"), std::string::npos);
  EXPECT_NE(message("a#A1 1 2 0\na#A1 1 2 0\n").find("has 2 corners, the board has 3"),
            std::string::npos);
  EXPECT_NE(message("a#A1 nan 2 0\n").find("'nan' is not a number"), std::string::npos);
}

// As mrcal-calibrate-cameras reads it: a weight of 2^-level.
TEST(CornersFile, LevelsOfMrcalDoubleTheStandardDeviation) {
  const auto read = ParseCornersVnl("c.vnl",
                                    "## generated with mrgingham --jobs 4\n# filename x y level\n"
                                    "a.png#A1 1.5 2.5 0\na.png#A1 3 4 1\na.png#A1 5 6 3\n",
                                    3);
  ASSERT_TRUE(read.ok()) << read.error().message;
  const auto& corners = (*read)[0].corners;
  EXPECT_EQ(corners[0]->covariance_px2, Eigen::Matrix2d(1 * Eigen::Matrix2d::Identity()));
  EXPECT_EQ(corners[1]->covariance_px2, Eigen::Matrix2d(4 * Eigen::Matrix2d::Identity()));
  EXPECT_EQ(corners[2]->covariance_px2, Eigen::Matrix2d(64 * Eigen::Matrix2d::Identity()));
}

TEST(CornersFile, ReadsATableWithoutLevels) {
  const auto read = ParseCornersVnl(
      "c.vnl", "# filename x y\na.png#A1 1 2\na.png#A1 - -\na.png#A1 5 6\na.png#B1 - -\n", 3);
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ((*read)[0].corners[2]->pixel, Eigen::Vector2d(5, 6));
  EXPECT_FALSE((*read)[0].corners[1].has_value());
  EXPECT_FALSE((*read)[1].rejected_because.empty());
  EXPECT_EQ((*read)[1].line, 5);
}

TEST(CornersFile, MissingCornersHaveADashANegativeLevelOrPlace) {
  const auto read = ParseCornersVnl(
      "c.vnl", "# filename x y level\na#A 1 2 -\na#A 1 2 -1\na#A -1 -1 0\na#A 7 8 0\n", 4);
  ASSERT_TRUE(read.ok()) << read.error().message;
  const auto& corners = (*read)[0].corners;
  EXPECT_FALSE(corners[0] || corners[1] || corners[2]);
  EXPECT_TRUE(corners[3].has_value());
}

TEST(CornersFile, AMissingFileIsAnErrorThatNamesIt) {
  const auto read = ReadCornersVnl("no/such/corners.vnl", 3);
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("no/such/corners.vnl"), std::string::npos);
}

}  // namespace
}  // namespace telestrain
