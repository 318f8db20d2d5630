#include "correlation/nearest_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

namespace telestrain::correlation {
namespace {

TEST(NearestPoints, AreThoseOfAFullSearch) {
  std::mt19937 random(1);
  for (const int range : {3, 40, 5000}) {  // many on one place, few, none
    std::vector<Eigen::Vector2i> points;
    const auto anywhere = [&] {
      return Eigen::Vector2i(static_cast<int>(random() % range),
                             static_cast<int>(random() % range));
    };
    for (int k = 0; k < 700; ++k) points.push_back(anywhere());
    const NearestPoints tree(points);
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::Vector2i at = anywhere() * 2 - Eigen::Vector2i::Constant(range / 2);
      std::vector<std::tuple<int, int>> all;
      for (int k = 0; k < 700; ++k) all.emplace_back((points[k] - at).squaredNorm(), k);
      std::sort(all.begin(), all.end());
      const std::vector<int> found = tree.Find(at, 5);
      ASSERT_EQ(found.size(), 5u);
      for (int k = 0; k < 5; ++k) EXPECT_EQ(found[k], std::get<1>(all[k])) << range;
    }
  }
}

TEST(NearestPoints, OfNoneAreNone) {
  EXPECT_TRUE(NearestPoints({}).Find({0, 0}, 3).empty());
  EXPECT_EQ(NearestPoints({{5, 5}}).Find({0, 0}, 3), std::vector<int>{0});
}

}  // namespace
}  // namespace telestrain::correlation
