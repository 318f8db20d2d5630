#include <gtest/gtest.h>

#include <numbers>

#include "target/target_detector.h"

namespace telestrain {
namespace {

Session SessionWithOneView() {
  Session session;
  session.sensor = {2592, 1944, 2.2};
  session.lens_magnification = 0.5;
  NominalView view;
  view.name = "A1";
  view.group = "A";
  view.region = {0, 0, 1296, 972};
  view.image_x_in_array = {-1, 0, 0};
  view.image_y_in_array = {0, std::cos(std::numbers::pi / 6), -0.5};
  view.axis_in_array = {0, 0.5, std::cos(std::numbers::pi / 6)};
  session.views = {view};
  session.target.columns = 13;
  session.target.rows = 9;
  session.target.square_mm = 0.3;
  session.target.boards = {{"A", Eigen::Vector3d::Zero(), 0}};
  return session;
}

TEST(SearchForBoard, ProjectsTheTargetsAxesThroughTheNominalView) {
  const Session session = SessionWithOneView();
  const TargetSearch search = SearchForBoard(session, session.views[0]);
  const double px_per_mm = 500 / 2.2;
  Eigen::Matrix2d wanted;
  wanted << -px_per_mm, 0, 0, px_per_mm * std::cos(std::numbers::pi / 6);
  EXPECT_LT((search.nominal_px_per_mm - wanted).norm(), 1e-9);
  EXPECT_EQ(search.columns, 13);
  EXPECT_EQ(search.region.width, 1296);
}

TEST(SearchForBoard, TurnsWithTheSubBoardOnItsPlate) {
  Session session = SessionWithOneView();
  const Eigen::Matrix2d straight = SearchForBoard(session, session.views[0]).nominal_px_per_mm;
  session.target.boards[0].rotation_rad = std::numbers::pi / 2;
  const Eigen::Matrix2d turned = SearchForBoard(session, session.views[0]).nominal_px_per_mm;
  EXPECT_LT((turned.col(0) - straight.col(1)).norm(), 1e-9);
  EXPECT_LT((turned.col(1) + straight.col(0)).norm(), 1e-9);
}

TEST(SearchForCross, LeavesTheSizeOpen) {
  const Session session = SessionWithOneView();
  const TargetSearch search = SearchForCross(session, session.views[0]);
  EXPECT_EQ(search.columns, 1);
  EXPECT_EQ(search.rows, 1);
  EXPECT_EQ(search.square_mm, 0);
}

}  // namespace
}  // namespace telestrain
