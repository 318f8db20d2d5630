#include "simulation/normal_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace telestrain {
namespace {

TEST(NormalShare, IsTheNormalDistributionFunction) {
  for (double x = -7; x < 7; x += 0.00137)
    ASSERT_NEAR(NormalShare(x), 0.5 * std::erfc(-x / std::sqrt(2.0)), 2e-9) << x;
  EXPECT_EQ(NormalShare(100), 1);
  EXPECT_EQ(NormalShare(-100), 0);
  EXPECT_EQ(NormalShare(std::numeric_limits<double>::infinity()), 1);
}

}  // namespace
}  // namespace telestrain
