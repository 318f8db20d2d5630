#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/numbers.h"
#include "dcc_fixture.h"

namespace telestrain {
namespace {

// The number that a printed one is in the certificate: the same digits, with the power of ten of a
// unit that the D-SI does not have.
double InDcc(const std::string& printed, const std::string& unit) {
  const auto number = ParseDouble(printed);
  if (!number) return NAN;
  const double scale = unit.starts_with("10⁻⁹")                              ? 1e-9
                       : unit.starts_with("10⁻⁶") || unit.starts_with("ppm") ? 1e-6
                                                                             : 1;
  return *number * scale;
}

void ExpectNumber(const std::string& found, const std::string& printed, const std::string& unit) {
  const double wanted = InDcc(printed, unit);
  if (std::isnan(wanted)) {
    EXPECT_EQ(found, "NaN") << printed;
    return;
  }
  EXPECT_DOUBLE_EQ(ParseDouble(found).value_or(NAN), wanted) << printed << " " << unit;
  EXPECT_TRUE(found.starts_with(printed.substr(0, printed.find('e')))) << found << " " << printed;
}

TEST_F(Dcc, QuantitiesAreThoseOfTheResults) {
  const auto quantities = ReadQuantities(Make());
  int count = 0, limits = 0;
  for (const Json& entry : ListAt(results_, "/quantities")) {
    const std::string unit = TextAt(entry, "/unit");
    const ReadQuantity read = QuantityOf(quantities, "telestrain_" + TextAt(entry, "/id"));
    ASSERT_EQ(read.values.size(), 1u) << entry.dump();
    EXPECT_EQ(read.name, Printed(entry["label"]));
    EXPECT_FALSE(read.name.empty());
    ExpectNumber(read.values[0], TextAt(entry, "/printed"), unit);
    ASSERT_EQ(read.uncertainties.size(), TextAt(entry, "/coverage_factor").empty() ? 0u : 1u);
    if (!read.uncertainties.empty()) {
      ExpectNumber(read.uncertainties[0], TextAt(entry, "/printed_uncertainty"), unit);
      EXPECT_EQ(ParseDouble(read.coverage_factor), NumberAt(entry, "/coverage_factor"));
      EXPECT_EQ(read.coverage_probability, "0.9545");  // erf(2 / sqrt(2))
    }
    const std::string verdict = TextAt(entry, "/verdict");
    EXPECT_EQ(read.conformity, verdict.empty() ? std::vector<std::string>{} : std::vector{verdict});
    if (const auto limit = NumberAt(entry, "/limit")) {
      ExpectNumber(read.upper, FormatShortest(*limit), unit);
      EXPECT_EQ(!read.lower.empty(), TextAt(entry, "/limit_kind") == "max_abs");
      ++limits;
    }
    ++count;
  }
  EXPECT_GE(count, 8);
  EXPECT_GE(limits, 7);
}

TEST_F(Dcc, RulerLengthsAreThoseOfTheResults) {
  const auto quantities = ReadQuantities(Make());
  const Json& rows = ListAt(FindBy(ListAt(results_, "/tables"), "id", "ruler"), "/rows");
  ASSERT_EQ(rows.size(), 11u);
  const ReadQuantity lengths = QuantityOf(quantities, "telestrain_ruler_Length");
  const ReadQuantity errors = QuantityOf(quantities, "basic_measurementError");
  EXPECT_EQ(lengths.units, std::vector<std::string>{"\\milli\\metre"});
  EXPECT_EQ(errors.units, std::vector<std::string>{"\\micro\\metre"});
  EXPECT_EQ(errors.coverage_factor, "2");
  ASSERT_EQ(lengths.values.size(), rows.size());
  ASSERT_EQ(errors.values.size(), rows.size());
  ASSERT_EQ(errors.uncertainties.size(), rows.size());
  ASSERT_EQ(errors.conformity.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(lengths.values[i], TextAt(rows[i][1], "/printed"));
    EXPECT_EQ(errors.values[i], TextAt(rows[i][2], "/printed"));
    EXPECT_EQ(errors.uncertainties[i], TextAt(rows[i][3], "/printed"));
    EXPECT_EQ(errors.conformity[i], TextAt(rows[i][4], "/verdict"));
  }
}

TEST_F(Dcc, MagnificationHasItsExpandedUncertaintyAndUnit) {
  const auto quantities = ReadQuantities(Make());
  const auto found =
      std::find_if(quantities.begin(), quantities.end(), [](const ReadQuantity& quantity) {
        return quantity.name.starts_with("Magnification") && !quantity.uncertainties.empty();
      });
  ASSERT_NE(found, quantities.end());
  // 227.2871436 ± 2 * 0.00612, rounded after the GUM.
  EXPECT_EQ(found->values, std::vector<std::string>{"227.287"});
  EXPECT_EQ(found->uncertainties, std::vector<std::string>{"0.012"});
  EXPECT_EQ(found->units, std::vector<std::string>{"\\milli\\metre\\tothe{-1}"});
  EXPECT_EQ(found->non_si_unit, "px/mm");
}

TEST_F(Dcc, TablesAreThoseOfTheResults) {
  const auto quantities = ReadQuantities(Make());
  int cells = 0;
  for (const char* id : {"views", "strain-states", "sequence-cycles", "ruler", "uncertainty"}) {
    const Json& table = FindBy(ListAt(results_, "/tables"), "id", id);
    const Json& columns = ListAt(table, "/columns");
    for (std::size_t i = 0; i < columns.size(); ++i) {
      std::string type = "telestrain_" + std::string(id) + "_" + TextAt(columns[i], "/name");
      for (char& c : type)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
      const ReadQuantity read = QuantityOf(quantities, type);
      for (std::size_t row = 0; row < read.values.size(); ++row, ++cells)
        ExpectNumber(read.values[row], TextAt(table["rows"][row][i], "/printed"),
                     TextAt(columns[i], "/unit"));
    }
  }
  // Columns of numbers without U: 10 of 4 views, 8 of 6 states, 4 of 1 cycle, 7 of 11 rulers, 2 of
  // 4 lines.
  EXPECT_EQ(cells, 10 * 4 + 8 * 6 + 4 * 1 + 7 * 11 + 2 * 4);
}

TEST_F(Dcc, DirectionsAreThoseOfTheCalibration) {
  const auto quantities = ReadQuantities(Make());
  const ReadQuantity read = QuantityOf(quantities, "telestrain_image_y_in_array");
  ASSERT_EQ(read.values.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(ParseDouble(read.values[i]),
              fixture_.calibration["views"][0]["image_y_in_array"][i].get<double>());
}

TEST_F(Dcc, DoubtIsConditional) {
  Make();
  for (Json& quantity : results_["quantities"]) quantity["verdict"] = "doubt";
  for (Json& table : results_["tables"])
    if (TextAt(table, "/id") == "ruler")
      table["rows"][1][4] = {{"verdict", "doubt"}, {"printed", "? doubt"}};
  for (Json& quantity : results_["quantities"])
    if (TextAt(quantity, "/id") == "ruler_error") quantity["value"] = 10.4;  // its limit is 10
  const auto xml = MakeDcc(results_, nullptr);
  ASSERT_TRUE(xml);
  const auto quantities = ReadQuantities(*xml);
  EXPECT_EQ(QuantityOf(quantities, "telestrain_reprojection_rms").conformity,
            std::vector<std::string>{"conditionalPass"});
  EXPECT_EQ(QuantityOf(quantities, "telestrain_ruler_error").conformity,
            std::vector<std::string>{"conditionalFail"});
  EXPECT_EQ(QuantityOf(quantities, "telestrain_ruler_E").conformity.at(1), "conditionalPass");
}

}  // namespace
}  // namespace telestrain
