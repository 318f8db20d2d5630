#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "measurement/strain.h"

namespace telestrain {

// The values of one state beyond the long base: local, split, gauges, mechanical; microstrain.
// Joins the keys of the state's object in strain.json.
nlohmann::ordered_json StrainDetailsJson(const StateStrain& strain);

// What the strain gauges read in one state, one entry per column of pipe.csv; null where a gauge
// has no value, or the state no row.
nlohmann::ordered_json GaugeReadingsJson(
    const std::vector<std::string>& columns,
    const std::vector<std::optional<double>>& readings_microstrain);

// What the strains of strain.json are, in words: definition, sign conventions, sources.
nlohmann::ordered_json StrainDefinitionsJson();

// A budget as strain.json has it, with every line's share of the variance.
nlohmann::ordered_json BudgetLinesJson(const std::vector<BudgetLine>& budget);

// Names and cells of the columns that strain.csv has beyond those of session-format.md, in order:
// the split with its standard uncertainties, local uncertainties, mechanical strain (empty without
// a temperature) and the camera at every gauge whose place is known.
std::vector<std::string> StrainDetailColumns(const StateStrain& first);
std::vector<std::string> StrainDetailCells(const StateStrain& strain);

}  // namespace telestrain
