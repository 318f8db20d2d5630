#include "report/dcc/dsi_number.h"

#include <gtest/gtest.h>

namespace telestrain {
namespace {

void ExpectUnit(const char* printed, const char* unit, int power_of_ten, const char* non_si) {
  const auto found = DsiUnitOf(printed);
  ASSERT_TRUE(found) << printed;
  EXPECT_EQ(found->unit, unit) << printed;
  EXPECT_EQ(found->power_of_ten, power_of_ten) << printed;
  EXPECT_EQ(found->non_si, non_si) << printed;
}

TEST(DsiUnit, OfEveryUnitOfTheReport) {
  ExpectUnit("", "\\one", 0, "");
  ExpectUnit("µm", "\\micro\\metre", 0, "");
  ExpectUnit("px", "\\one", 0, "px");
  ExpectUnit("px/mm", "\\milli\\metre\\tothe{-1}", 0, "px/mm");
  ExpectUnit("1/mm²", "\\milli\\metre\\tothe{-2}", 0, "");
  ExpectUnit("ppm/mm⁴", "\\milli\\metre\\tothe{-4}", -6, "");
  ExpectUnit("µm/mm", "\\micro\\metre\\milli\\metre\\tothe{-1}", 0, "");
  ExpectUnit("µε/h", "\\micro\\metre\\metre\\tothe{-1}\\hour\\tothe{-1}", 0, "");
  ExpectUnit("10⁻⁹ px", "\\one", -9, "10⁻⁹ px");
  ExpectUnit("10⁻⁹ rad", "\\radian", -9, "");
  ExpectUnit("10⁻⁹", "\\one", -9, "");
  ExpectUnit("°", "\\degree", 0, "");
}

TEST(DsiUnit, OfAnUnknownUnitIsNone) {
  for (const char* printed : {"mm or °", "bytes", "furlong", "m/µε", "mm//s", "10⁻⁹px2"})
    EXPECT_FALSE(DsiUnitOf(printed)) << printed;
}

TEST(DsiNumber, KeepsTheDigits) {
  EXPECT_EQ(DsiNumber("-31.27", -6), "-31.27E-6");
  EXPECT_EQ(DsiNumber("227.280", 0), "227.280");
  EXPECT_EQ(DsiNumber("-1.20e-06", -6), "-1.20E-12");
  EXPECT_EQ(DsiNumber("1.2e+06", -6), "1.2");
  for (const char* printed : {"–", "", "< 1e-12", "1 of 3", "yes", "1,5", "inf", "nan"})
    EXPECT_FALSE(DsiNumber(printed, 0)) << printed;
}

TEST(CoverageProbability, IsThatOfTheNormalDistribution) {
  EXPECT_EQ(CoverageProbability(1), "0.6827");  // JCGM 100, table G.1
  EXPECT_EQ(CoverageProbability(1.96), "0.9500");
  EXPECT_EQ(CoverageProbability(2), "0.9545");
  EXPECT_EQ(CoverageProbability(3), "0.9973");
  EXPECT_EQ(CoverageProbability(10), "0.9999");
}

}  // namespace
}  // namespace telestrain
