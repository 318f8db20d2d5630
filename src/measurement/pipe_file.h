#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "measurement/pipe_measurement.h"

namespace telestrain {

// strain.csv: its header and the line of one state, with their line ends.
std::string StrainCsvHeader();
std::string StrainCsvLine(const MeasuredState& state);

// strain_components.csv, one line per state: membrane, bending, torsion, mechanical strain and the
// camera's strain at every gauge, each with its standard uncertainty.
std::string StrainComponentsCsv(const std::vector<MeasuredState>& states);

// strain.json; `made_from` names the inputs with their SHA-256.
nlohmann::ordered_json StrainJson(const PipeMeasurement& measurement,
                                  const std::map<std::string, std::string>& made_from);

// "pipe_000.vtp" for the reference and so on.
std::string SurfaceFileName(std::size_t state);

// The surface of one state as VTK XML PolyData: points where they are in that state (array frame,
// mm), displacement, strain tensor, quality and uncertainty as point data, with `geometry` the
// roundness too; quads between grid neighbours.
std::string SurfaceVtp(const PipeGrid& grid, const StateStrain& state,
                       const PipeGeometry* geometry = nullptr);

}  // namespace telestrain
