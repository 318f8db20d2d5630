#include "session/made_from.h"

#include <nlohmann/json.hpp>
#include <system_error>
#include <tuple>

#include "base/files.h"
#include "base/json_file.h"
#include "base/utf8.h"

namespace telestrain {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Status RequireConsistent(const fs::path& results, Step before) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const Json inputs,
      ReadJson(results / "inputs.json", "telestrain.inputs/1", "telestrain detect"));
  for (const auto& [step, name, schema, maker] :
       {std::tuple{Step::kDetect, "detection.json", "telestrain.detection/1", "telestrain detect"},
        std::tuple{Step::kCalibrate, "calibration.json", "telestrain.calibration/1",
                   "telestrain calibrate"},
        std::tuple{Step::kDiagnose, "mrcal.json", "telestrain.mrcal/1", "telestrain diagnose"},
        std::tuple{Step::kVerify, "ruler.json", "telestrain.ruler/1", "telestrain verify"},
        std::tuple{Step::kMeasure, "strain.json", "telestrain.strain/1", "telestrain measure"}}) {
    if (step >= before) continue;
    std::error_code code;
    if (!fs::exists(results / name, code)) continue;
    TELESTRAIN_ASSIGN_OR_RETURN(const Json json, ReadJson(results / name, schema, maker));
    const Json made_from = json.contains("made_from") ? json["made_from"] : Json::object();
    if (!made_from.is_object())
      return BadInput((results / name).string() +
                      ": made_from is no table of names and hashes; run '" + maker + "' again");
    for (const auto& [source, hash] : made_from.items()) {
      // Results stand side by side: what is named is no path to anything else of the machine.
      if (source.empty() || source.find('/') != std::string::npos || source == "..")
        return BadInput((results / name).string() + ": made_from names '" + PrintableText(source) +
                        "', which is no file beside it; run '" + maker + "' again");
      const Result<std::string> found = Sha256HexOfFile(results / source);
      if (!found)
        return BadInput((results / name).string() + ": was made from " + found.error().message);
      if (hash == *found) continue;
      return BadInput((results / name).string() + ": was made from another " + source +
                      " than the one that lies beside it; run '" + maker + "' again");
    }
  }
  return {};
}

}  // namespace telestrain
