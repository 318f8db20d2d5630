#include "report/plot_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace telestrain {
namespace {

PlotScale Logarithmic(double low, double high, double length_pt = 400) {
  PlotAxis axis;
  axis.low = low;
  axis.high = high;
  axis.logarithmic = true;
  return {axis, length_pt, 38};
}

std::vector<std::string> Labels(const PlotScale& scale) {
  std::vector<std::string> labels;
  for (const PlotScale::Tick& tick : scale.Ticks())
    if (!tick.label.empty()) labels.push_back(tick.label);
  return labels;
}

TEST(PlotScale, LinearTicksStandAtRoundNumbersAndHoldTheRange) {
  const PlotScale scale({"", -0.37, 1.93}, 300, 38);
  EXPECT_LE(scale.low(), -0.37);
  EXPECT_GE(scale.high(), 1.93);
  EXPECT_EQ(Labels(scale), (std::vector<std::string>{"-0.5", "0.0", "0.5", "1.0", "1.5", "2.0"}));
  EXPECT_DOUBLE_EQ(scale.Share(scale.low()), 0);
  EXPECT_DOUBLE_EQ(scale.Share(scale.high()), 1);
}

TEST(PlotScale, ALogarithmicScaleGivesEqualLengthToEqualRatios) {
  const PlotScale scale = Logarithmic(0.03, 700);
  EXPECT_LE(scale.low(), 0.03);
  EXPECT_GE(scale.high(), 700);
  const double decade = scale.Share(1) - scale.Share(0.1);
  EXPECT_NEAR(scale.Share(100) - scale.Share(10), decade, 1e-12);
  EXPECT_NEAR(scale.Share(0.2) - scale.Share(0.1), scale.Share(20) - scale.Share(10), 1e-12);
}

TEST(PlotScale, LogarithmicTicksAreLabelledAsDenselyAsThereIsRoom) {
  EXPECT_EQ(
      Labels(Logarithmic(0.1, 100)),
      (std::vector<std::string>{"0.1", "0.2", "0.5", "1", "2", "5", "10", "20", "50", "100"}));
  EXPECT_EQ(Labels(Logarithmic(1e-6, 1)),
            (std::vector<std::string>{"10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "10⁰"}));
  EXPECT_EQ(Labels(Logarithmic(2, 5)), (std::vector<std::string>{"2", "3", "4", "5"}));
  for (const double high : {1e10, 1e20, 1e30, 1e60})
    EXPECT_LE(Labels(Logarithmic(1, high)).size(), 12u) << high;
}

TEST(PlotScale, AnEmptyRangeIsWidened) {
  EXPECT_LT(Logarithmic(3, 3).low(), Logarithmic(3, 3).high());
  const PlotScale linear({"", 5, 5}, 300, 38);
  EXPECT_LT(linear.low(), linear.high());
}

TEST(PlotScale, ALogarithmicAxisOfZeroIsABrokenContract) {
  EXPECT_THROW(Logarithmic(0, 1), std::logic_error);
}

// Of a damaged file.
TEST(PlotScale, AnyRangeHasAFewTicks) {
  const double huge = 1.7e308, nan = std::nan("");
  const PlotScale scales[] = {{{"", 1e20, 1e20}, 300, 38}, {{"", -huge, huge}, 300, 38},
                              {{"", huge, huge}, 300, 38}, {{"", nan, nan}, 300, 38},
                              {{"", 0, 5e-324}, 300, 38},  Logarithmic(5e-324, 5e-324),
                              Logarithmic(5e-324, huge)};
  for (const PlotScale& scale : scales) {
    EXPECT_LT(scale.Ticks().size(), 300u);
    EXPECT_LT(scale.low(), scale.high());
    EXPECT_EQ(scale.Share(scale.low()), 0);
    EXPECT_EQ(scale.Share(scale.high()), 1);
  }
}

}  // namespace
}  // namespace telestrain
