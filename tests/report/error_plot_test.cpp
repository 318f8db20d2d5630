#include "report/error_plot.h"

#include <gtest/gtest.h>

namespace telestrain {
namespace {

std::vector<ErrorPoint> Points(double error, double expanded_uncertainty) {
  ErrorPoint point;
  point.error = error;
  point.expanded_uncertainty = expanded_uncertainty;
  return {point};
}

// Errors of 0.02 µm beside a limit of 10 µm would be a flat line: the errors set the scale.
TEST(ErrorPlot, AWideLimitDoesNotFlattenTheErrors) {
  const ErrorRange range = RangeOfErrors(Points(-0.02, 0.01), 10.0);
  EXPECT_FALSE(range.limit_is_inside);
  EXPECT_GE(range.reach, 0.03);
  EXPECT_LT(range.reach, 0.04);
}

TEST(ErrorPlot, ALimitNearTheErrorsIsInside) {
  const ErrorRange range = RangeOfErrors(Points(5, 1), 10.0);
  EXPECT_TRUE(range.limit_is_inside);
  EXPECT_GE(range.reach, 10);
}

TEST(ErrorPlot, AnExceededLimitIsInside) {
  const ErrorRange range = RangeOfErrors(Points(25, 1), 10.0);
  EXPECT_TRUE(range.limit_is_inside);
  EXPECT_GE(range.reach, 26);
}

TEST(ErrorPlot, ErrorsOfZeroHaveARange) {
  EXPECT_GT(RangeOfErrors(Points(0, 0), {}).reach, 0);
  EXPECT_TRUE(RangeOfErrors(Points(0, 0), 3.0).limit_is_inside);
}

}  // namespace
}  // namespace telestrain
