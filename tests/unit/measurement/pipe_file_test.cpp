#include "measurement/pipe_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace telestrain {
namespace {

TEST(StrainJson, EveryStateSaysWhatEachGaugeRead) {
  PipeMeasurement measurement;
  measurement.grid.pairs.resize(2);
  measurement.gauge_columns = {"gauge_1_microstrain", "gauge_2_microstrain"};
  measurement.states.resize(3);
  measurement.states[0].table.gauges_microstrain = {-0.5, 1.25};
  measurement.states[1].table.gauges_microstrain = {std::nullopt, 250.5};
  const auto states = StrainJson(measurement, {}).at("states");
  for (const std::size_t i : {0u, 1u, 2u})
    for (const std::size_t gauge : {0u, 1u})
      EXPECT_EQ(states.at(i).at("gauge_readings").at(gauge).at("column"),
                measurement.gauge_columns[gauge]);
  EXPECT_EQ(states.at(0).at("gauge_readings").at(0).at("microstrain"), -0.5);
  EXPECT_EQ(states.at(0).at("gauge_readings").at(1).at("microstrain"), 1.25);
  EXPECT_TRUE(states.at(1).at("gauge_readings").at(0).at("microstrain").is_null());
  EXPECT_EQ(states.at(1).at("gauge_readings").at(1).at("microstrain"), 250.5);
  // A watched state that no table names.
  EXPECT_TRUE(states.at(2).at("gauge_readings").at(1).at("microstrain").is_null());
}

}  // namespace
}  // namespace telestrain
