#include "app/step_options.h"

#include <nlohmann/json.hpp>

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

bool IsDefault(const Json& value) {
  return value.is_null() || value == false || value == "" || (value.is_array() && value.empty()) ||
         (value.is_number() && value == 0);
}

std::string WordOf(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

Json OptionsJson(const CalibrateArguments& arguments) {
  return {{"compare", arguments.compare},
          {"outliers", arguments.outliers},
          {"board-warp", arguments.board_warp},
          {"cull", arguments.culled}};
}

Json OptionsJson(const MeasureArguments& arguments) {
  return {{"subset-px", arguments.subset_px},
          {"step-px", arguments.step_px},
          {"watch", arguments.watch},
          {"until", arguments.until},
          {"idle-s", arguments.idle_s}};
}

Json OptionsJson(const RenderOptions& options) {
  Json json{{"view", options.view},
            {"reported", options.only_reported},
            {"state", options.state},
            {"quantity", options.quantity},
            {"range", Json::array()},
            {"size", std::to_string(options.width_px) + "x" + std::to_string(options.height_px)},
            {"dpi", options.dots_per_inch},
            {"transparent", options.transparent},
            {"backend", options.backend == GlBackend::kEgl ? "egl" : "osmesa"}};
  if (options.range) json["range"] = *options.range;
  return json;
}

std::vector<std::string> OptionWords(const Json& options) {
  std::vector<std::string> words;
  for (const auto& [name, value] : options.items()) {
    if (IsDefault(value)) continue;
    if (value.is_array()) {
      words.push_back("--" + name);
      for (const Json& item : value) words.push_back(WordOf(item));
    } else {
      words.push_back("--" + name + (value == true ? "" : "=" + WordOf(value)));
    }
  }
  return words;
}

}  // namespace telestrain
