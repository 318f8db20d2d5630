#include "study/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace telestrain {
namespace {

TEST(Statistics, FiguresOfAListAreThoseOfItsDefinition) {
  const ErrorFigures figures = FiguresOf({1, -3, 2});
  EXPECT_EQ(figures.count, 3);
  EXPECT_NEAR(figures.mean, 0, 1e-15);  // rounding of three thirds
  EXPECT_DOUBLE_EQ(figures.sd, std::sqrt(14.0 / 2));
  EXPECT_DOUBLE_EQ(figures.rms, std::sqrt(14.0 / 3));
  EXPECT_DOUBLE_EQ(figures.max_abs, 3);
  EXPECT_EQ(FiguresOf({}).count, 0);
  EXPECT_EQ(FiguresOf({5}).sd, 0);  // one value does not scatter
}

TEST(Statistics, AHistogramHoldsEveryValueOnce) {
  const Histogram histogram = HistogramOf({-9, 0.1, 0.6, 0.6, 99}, 0, 1, 2);
  ASSERT_EQ(histogram.centers, (std::vector<double>{0.25, 0.75}));
  EXPECT_DOUBLE_EQ(histogram.percent[0], 40);  // -9 falls into the first bin, 99 into the last
  EXPECT_DOUBLE_EQ(histogram.percent[1], 60);
}

TEST(Statistics, AProfileSortsErrorsByTheirPlace) {
  const Profile profile = ProfileOf({-1, -0.9, 0.9, 1}, {1, -1, 3, 3}, 4);
  // The two bins in the middle are empty and left out.
  ASSERT_EQ(profile.position, (std::vector<double>{-0.75, 0.75}));
  EXPECT_EQ(profile.count, (std::vector<int>{2, 2}));
  EXPECT_EQ(profile.mean, (std::vector<double>{0, 3}));
  EXPECT_EQ(profile.rms, (std::vector<double>{1, 3}));
}

}  // namespace
}  // namespace telestrain
