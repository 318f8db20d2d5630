#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "report/json_lookup.h"

namespace telestrain {

// The Digital Calibration Certificate (DCC 3.3.0, PTB) of the calibration and its proof on the
// ruler, as XML text: administrative data from `results` (results.json: document, quantities,
// software, artefacts), measurement results from `calibration` (calibration.json) and the
// quantities. A value that the DCC wants and the session does not give is written as "not stated".
// Numbers are those that the report prints. Pure function: same input, same bytes.
Result<std::string> MakeDcc(const Json& results, const Json& calibration);

// Checks a DCC against dcc.xsd in `schema_folder` (with its catalog.xml), offline. Fails
// (kBadInput) with the line and the schema's complaint.
Status ValidateDcc(const std::string& name, const std::string& xml,
                   const std::filesystem::path& schema_folder);

}  // namespace telestrain
