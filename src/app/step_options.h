#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/render_arguments.h"

namespace telestrain {

// Every option of a verb with its value, by its flag without the dashes, as the audit trail keeps
// it; places of results are left out.
nlohmann::ordered_json OptionsJson(const CalibrateArguments& arguments);
nlohmann::ordered_json OptionsJson(const MeasureArguments& arguments);
nlohmann::ordered_json OptionsJson(const RenderOptions& options);

// The words that give a verb these options again: {"cull": ["1,2,3,4"], "board-warp": true} is
// --cull 1,2,3,4 --board-warp. Empty texts and lists, false, null and 0 are every verb's defaults.
std::vector<std::string> OptionWords(const nlohmann::ordered_json& options);

}  // namespace telestrain
