#include <gtest/gtest.h>

#include <cstdio>
#include <iostream>

#include "random_view.h"
#include "target/target_detector.h"

namespace telestrain {
namespace {

using testing::BoardScene;
using testing::RandomView;
using testing::ViewLimits;

struct Tally {
  int whole = 0, found = 0, rejected = 0, wrong = 0, holes = 0;
  double largest_error_px = 0;
};

// Runs one view: a board whose corners are all 2 px inside must be found, and whatever is found
// must carry the right labels.
void RunView(const RandomView& view, std::uint32_t seed, Tally* tally) {
  const BoardObservation observation = DetectBoard(testing::Render(view, seed), view.search);
  const bool is_whole = view.LeastDistanceToEdge_px(0) > 2;
  const bool is_found = observation.rejected_because.empty();
  tally->whole += is_whole;
  tally->found += is_found;
  tally->rejected += !is_found;
  EXPECT_TRUE(is_found || !is_whole) << "seed " << seed << ": " << observation.rejected_because;
  if (!is_found) {
    EXPECT_TRUE(observation.corners.empty());
    return;
  }
  ASSERT_EQ(observation.corners.size(),
            static_cast<std::size_t>(view.scene.columns * view.scene.rows));
  for (int row = 0; row < view.scene.rows; ++row)
    for (int column = 0; column < view.scene.columns; ++column) {
      const auto& corner =
          observation.corners[static_cast<std::size_t>(row * view.scene.columns + column)];
      tally->holes += is_whole && !corner.has_value();
      if (!corner) continue;
      const double error = (corner->pixel - view.scene.Corner(column, row)).norm();
      tally->wrong += error > 1;
      tally->largest_error_px = std::max(tally->largest_error_px, error);
    }
}

void Report(const char* what, const Tally& tally) {
  std::cout << what << ": whole " << tally.whole << ", found " << tally.found << ", rejected "
            << tally.rejected << ", missing corners " << tally.holes << ", largest error "
            << tally.largest_error_px << " px\n";
}

void RunMany(const char* what, const ViewLimits& limits, int count, std::uint32_t first_seed) {
  Tally tally;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t seed = first_seed + static_cast<std::uint32_t>(i);
    RunView(testing::MakeRandomView(limits, seed), seed, &tally);
  }
  Report(what, tally);
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_GT(tally.whole, count / 4);
  EXPECT_LE(tally.holes, tally.found / 4);  // one corner in some 500
}

TEST(DetectBoard, FindsEveryWholeBoardAtFullSize) {
  RunMany("68 px squares", ViewLimits{}, 40, 1000);
}

TEST(DetectBoard, FindsEveryWholeBoardWithSmallerSquares) {
  ViewLimits limits;
  limits.side_px = 34;
  limits.region = {7, 11, 648, 486};
  limits.shift_px = 40;
  limits.largest_blur_px = 2;
  limits.tilt_rad = 0.6;
  RunMany("34 px squares", limits, 100, 2000);
}

TEST(DetectBoard, FindsEveryWholeBoardOfABinnedSensor) {
  ViewLimits limits;
  limits.side_px = 15;
  limits.region = {324, 0, 324, 243};
  limits.shift_px = 12;
  limits.least_blur_px = 0.5;
  limits.largest_blur_px = 1.2;
  RunMany("15 px squares", limits, 150, 3000);
}

TEST(DetectBoard, HoldsWithFiveGreyLevelsOfNoise) {
  ViewLimits limits;
  limits.side_px = 17;
  limits.region = {0, 0, 324, 243};
  limits.shift_px = 10;
  limits.least_blur_px = 0.5;
  limits.largest_blur_px = 1.5;
  limits.noise_gray = 5;
  RunMany("17 px squares, noise 5", limits, 60, 4000);
}

RandomView FrontalView() {
  ViewLimits limits;
  limits.side_px = 30;
  limits.region = {0, 0, 600, 450};
  limits.tilt_rad = 0.01;
  limits.turn_rad = 0.05;
  limits.shift_px = 5;
  limits.largest_blur_px = 1;
  for (std::uint32_t seed = 5;; ++seed) {
    const RandomView view = testing::MakeRandomView(limits, seed);
    if (std::abs(view.scene.side_px(0, 0)) > 25) return view;  // its rows run along the image's
  }
}

int CountSeen(const BoardObservation& observation) {
  return static_cast<int>(std::count_if(observation.corners.begin(), observation.corners.end(),
                                        [](const auto& corner) { return corner.has_value(); }));
}

// Every corner that is given is where the truth has it.
void ExpectRightLabels(const RandomView& view, const BoardObservation& observation) {
  for (int i = 0; i < static_cast<int>(observation.corners.size()); ++i)
    if (const auto& corner = observation.corners[static_cast<std::size_t>(i)]) {
      EXPECT_LT((corner->pixel - view.scene.Corner(i % 13, i / 13)).norm(), 0.1) << i;
    }
}

double HalfWidth_px(const RandomView& view) {
  return 0.5 * (12 * std::abs(view.scene.side_px(0, 0)) + 8 * std::abs(view.scene.side_px(0, 1)));
}

TEST(DetectBoard, GivesTheCornersOfABoardWithOneBorderInTheView) {
  for (const bool bright_plate : {true, false}) {
    RandomView view = FrontalView();
    view.scene.plate_gray = bright_plate ? view.scene.bright_gray : view.scene.dark_gray;
    view.scene.origin_px.x() -= 300 - HalfWidth_px(view) + 100;  // 100 px of it are out of the view
    const auto observation = DetectBoard(testing::Render(view, 1), view.search);
    ASSERT_EQ(observation.rejected_because, "");
    EXPECT_GE(CountSeen(observation), 9 * 8);
    EXPECT_LE(CountSeen(observation), 9 * 10);
    ExpectRightLabels(view, observation);
  }
}

TEST(DetectBoard, SaysWhyABoardWithoutEndsCannotBeCounted) {
  RandomView view = FrontalView();
  view.search.region = {0, 0, 300, 450};  // cuts the board on the left and on the right
  view.scene.origin_px.x() -= 160;
  const auto observation = DetectBoard(testing::Render(view, 1), view.search);
  EXPECT_TRUE(observation.corners.empty());
  EXPECT_NE(observation.rejected_because.find("cut off or covered at both ends of its "),
            std::string::npos)
      << observation.rejected_because;
  EXPECT_NE(observation.rejected_because.find("cannot be counted; move the target"),
            std::string::npos);
}

// The border must be seen as such: a plate of another level leaves the end open.
TEST(DetectBoard, TakesNoOtherEdgeForTheBoardsBorder) {
  RandomView view = FrontalView();
  view.scene.origin_px.x() -= 300 - HalfWidth_px(view) + 100;
  view.scene.plate_gray = 0.5 * (view.scene.bright_gray + view.scene.dark_gray);
  EXPECT_FALSE(DetectBoard(testing::Render(view, 1), view.search).rejected_because.empty());
}

TEST(DetectBoard, RefusesASaturatedBoard) {
  RandomView view = FrontalView();
  view.scene.bright_gray = 270;
  EXPECT_NE(DetectBoard(testing::Render(view, 1), view.search).rejected_because.find("saturated: "),
            std::string::npos);
  view.scene.bright_gray = 200;
  view.scene.dark_gray = -20;
  EXPECT_NE(
      DetectBoard(testing::Render(view, 1), view.search).rejected_because.find("underexposed: "),
      std::string::npos);
}

TEST(DetectBoard, RejectsAnEmptyViewAndSaysWhatItShows) {
  const RandomView view = FrontalView();
  for (const double noise : {0.0, 5.0, 30.0}) {
    GrayImage image = testing::Blank(610, 460, 100);
    testing::AddNoise(&image, noise, 7);
    // 98 % of normal numbers lie within 2.33 standard deviations; whole levels.
    const auto reason = DetectBoard(image, view.search).rejected_because;
    int low = 0, high = 0;
    ASSERT_EQ(std::sscanf(reason.c_str(),
                          "no board in the view: 98 %% of its grey levels lie from %d to %d of 255",
                          &low, &high),
              2)
        << reason;
    EXPECT_NEAR(low, 100 - 2.33 * noise, 1 + 0.05 * noise);
    EXPECT_NEAR(high, 100 + 2.33 * noise, 1 + 0.05 * noise);
  }
  GrayImage bright = testing::Blank(610, 460, 255);
  const auto reason = DetectBoard(bright, view.search).rejected_because;
  EXPECT_NE(reason.find("100 % of its pixels are saturated; looked for squares of 30 px"),
            std::string::npos)
      << reason;
}

TEST(DetectBoard, RejectsABoardFarOutOfFocus) {
  RandomView view = FrontalView();
  for (const double blur : {7.0, 9.0, 15.0}) {
    view.scene.blur_px = blur;
    const auto observation = DetectBoard(testing::Render(view, 3), view.search);
    EXPECT_TRUE(observation.corners.empty());
    EXPECT_FALSE(observation.rejected_because.empty()) << blur;
  }
}

TEST(DetectBoard, RejectsABoardWithAnotherNumberOfSquares) {
  RandomView view = FrontalView();
  view.search.columns = 12;
  const auto observation = DetectBoard(testing::Render(view, 3), view.search);
  EXPECT_NE(observation.rejected_because.find("another pattern"), std::string::npos)
      << observation.rejected_because;
}

TEST(DetectBoard, RejectsSquaresOfAnotherSize) {
  RandomView view = FrontalView();
  view.search.square_mm *= 1.6;
  const auto observation = DetectBoard(testing::Render(view, 3), view.search);
  EXPECT_NE(observation.rejected_because.find("another pattern: squares of"), std::string::npos)
      << observation.rejected_because;
}

void Cover(const Eigen::Vector2d& at, double half_px, float gray, GrayImage* image) {
  for (int y = static_cast<int>(at.y() - half_px); y <= at.y() + half_px; ++y)
    for (int x = static_cast<int>(at.x() - half_px); x <= at.x() + half_px; ++x)
      image->At(x, y) = gray;
}

TEST(DetectBoard, LeavesOutACornerUnderDust) {
  const RandomView view = FrontalView();
  GrayImage image = testing::Render(view, 3);
  Cover(view.scene.Corner(6, 4), 12, 60, &image);
  const auto observation = DetectBoard(image, view.search);
  ASSERT_EQ(observation.rejected_because, "");
  EXPECT_FALSE(observation.corners[4 * 13 + 6].has_value());
  const auto seen = std::count_if(observation.corners.begin(), observation.corners.end(),
                                  [](const auto& corner) { return corner.has_value(); });
  EXPECT_GE(seen, 112);  // the four neighbours may suffer with it
}

TEST(DetectBoard, GivesTheCornersAboutACover) {
  const RandomView view = FrontalView();
  GrayImage image = testing::Render(view, 3);
  Cover(view.scene.Corner(6, 4), 70, 60, &image);
  const auto observation = DetectBoard(image, view.search);
  ASSERT_EQ(observation.rejected_because, "");
  EXPECT_FALSE(observation.corners[4 * 13 + 6].has_value());
  EXPECT_GE(CountSeen(observation), 117 - 36);
  ExpectRightLabels(view, observation);
}

TEST(DetectBoard, JoinsWhatABarSeparates) {
  RandomView view = FrontalView();
  GrayImage image = testing::Render(view, 3);
  for (int y = 0; y < 450; ++y)
    for (int x = 270; x < 330; ++x) image.At(x, y) = 90;
  const auto observation = DetectBoard(image, view.search);
  ASSERT_EQ(observation.rejected_because, "");
  EXPECT_GE(CountSeen(observation), 9 * 9);
  ExpectRightLabels(view, observation);
}

TEST(DetectBoard, RejectsTwoBoardsInOneView) {
  RandomView view = FrontalView();
  const double shift = 430;
  view.search.region.height = 900;
  GrayImage image = testing::Blank(610, 910, 100);
  testing::DrawBoard(view.scene, {0, 0, 600, 445}, &image);
  BoardScene second = view.scene;
  second.origin_px.y() += shift;
  testing::DrawBoard(second, {0, 445, 600, 455}, &image);
  testing::AddNoise(&image, 1, 9);
  EXPECT_EQ(DetectBoard(image, view.search).rejected_because,
            "2 boards in the view where one is expected");
}

TEST(DetectBoard, GivesTheSameBitsEveryTime) {
  const RandomView view = FrontalView();
  const GrayImage image = testing::Render(view, 3);
  const auto a = DetectBoard(image, view.search), b = DetectBoard(image, view.search);
  ASSERT_EQ(a.corners.size(), b.corners.size());
  for (std::size_t i = 0; i < a.corners.size(); ++i)
    EXPECT_EQ(a.corners[i]->pixel, b.corners[i]->pixel);
}

}  // namespace
}  // namespace telestrain
