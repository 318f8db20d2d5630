#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace telestrain::viz {

// The tables of results.json as HTML. Texts are escaped. `results` has the shape that
// RequireResultsShape() asks for.

// Every table, each folded away but for the few that a reader wants first.
std::string TablesHtml(const nlohmann::ordered_json& results);

// What was decided: a row for every quantity with a limit, with the reason of its verdict.
std::string ReasonsHtml(const nlohmann::ordered_json& results);

// Sign and word of "pass", "doubt", "fail"; of anything else those of "undecided".
struct VerdictLook {
  std::string key, sign, word;
};
VerdictLook LookOf(const std::string& verdict);

}  // namespace telestrain::viz
