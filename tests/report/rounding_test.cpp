#include "report/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "base/numbers.h"

namespace telestrain {
namespace {

// Places asked for: 2, 3, 2 and none; a zero would hide what the column says otherwise.
TEST(Rounding, AColumnHasOnePlace) {
  EXPECT_EQ(DecimalsOfColumn({0.25, 0.012, 0.31, 0}), 2);
  EXPECT_EQ(DecimalsOfColumn({120}), -1);
  EXPECT_EQ(DecimalsOfColumn({0}), std::nullopt);
  EXPECT_EQ(PrintAtDecimals(745.244, 2), "745.24");
  EXPECT_EQ(PrintAtDecimals(4567, -1), "4570");
}

TEST(Rounding, KeepsTwoDigitsOfTheUncertainty) {
  struct Case {
    double value, uncertainty;
    const char *printed_value, *printed_uncertainty;
  };
  const Case cases[] = {
      {12.34567, 0.0123, "12.346", "0.012"},
      {12.34567, 0.0127, "12.346", "0.013"},
      {4567, 123, "4570", "120"},
      {4567, 1270, "4600", "1300"},
      {-0.0004, 0.013, "0.000", "0.013"},
      {1.5, 0.0996, "1.50", "0.10"},
      {99.96, 9.96, "100", "10"},
      {3, 1, "3.0", "1.0"},
      {3, 10, "3", "10"},
      {-2.345, 0.1, "-2.35", "0.10"},
      {8.00266, 0.00226, "8.0027", "0.0023"},
      {1e-6, 2.5e-8, "0.000001000", "0.000000025"},
  };
  for (const Case& c : cases) {
    const PrintedResult printed = PrintWithUncertainty(c.value, c.uncertainty);
    EXPECT_EQ(printed.value, c.printed_value) << c.value << " ± " << c.uncertainty;
    EXPECT_EQ(printed.uncertainty, c.printed_uncertainty) << c.value << " ± " << c.uncertainty;
  }
}

TEST(Rounding, StaysWithinHalfAUnitOfTheLastPlace) {
  for (int i = 1; i < 2000; ++i) {
    const double uncertainty = std::pow(10.0, -4 + 0.004 * i), value = std::sin(i) * 50;
    const PrintedResult printed = PrintWithUncertainty(value, uncertainty);
    // Two digits: the last place is at most a tenth of U, and U is at least ten such places.
    EXPECT_NEAR(*ParseDouble(printed.uncertainty), uncertainty, 0.0501 * uncertainty);
    EXPECT_NEAR(*ParseDouble(printed.value), value, 0.0501 * uncertainty);
  }
}

TEST(Rounding, RefusesAnUncertaintyThatIsNone) {
  EXPECT_THROW(PrintWithUncertainty(1, 0), std::logic_error);
  EXPECT_THROW(PrintWithUncertainty(1, NAN), std::logic_error);
}

TEST(Rounding, PrintsSignificantDigits) {
  EXPECT_EQ(PrintSignificant(0.123456, 4), "0.1235");
  EXPECT_EQ(PrintSignificant(227.287, 6), "227.287");
  EXPECT_EQ(PrintSignificant(-3.1274e-5, 4), "-3.127e-05");
  EXPECT_EQ(PrintSignificant(1.2e-300, 2), "1.2e-300");
  EXPECT_EQ(PrintSignificant(98124.4, 3), "98100");
  EXPECT_EQ(PrintSignificant(0, 3), "0.00");
  EXPECT_EQ(PrintSignificant(0.0996, 2), "0.10");  // a digit is not added by rounding up
  EXPECT_EQ(PrintSignificant(9.96, 2), "10");
}

TEST(Rounding, AnUncertaintyAloneHasTwoDigitsToo) {
  for (int i = 1; i < 2000; ++i) {
    const double uncertainty = std::pow(10.0, -3.9 + 0.004 * i);
    EXPECT_EQ(PrintUncertainty(uncertainty), PrintWithUncertainty(0, uncertainty).uncertainty);
  }
}

}  // namespace
}  // namespace telestrain
