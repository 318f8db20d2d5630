#include "report/report_template.h"

#include <map>
#include <optional>
#include <vector>

#include "base/numbers.h"

namespace telestrain {
namespace {

enum class Kind { kText, kNumber, kBool, kTexts };

struct Key {
  Kind kind;
  bool required;
};
using Keys = std::map<std::string, Key>;

constexpr const char* kSchema = "telestrain.template/1";

// clang-format off
constexpr const char* kTableNames[] = {
    "summary", "document", "artefacts", "software", "input-files", "result-files", "lens",
    "views", "lens-of-view", "reprojection", "poses", "boards", "boards-rejected", "stage",
    "model-tests", "gauge", "ruler", "ruler-summary", "ruler-budget", "ruler-rejected",
    "strain-states", "strain-beam", "strain-comparison", "strain-budget", "strain-rejected",
    "pipe", "correlation", "corners-rejected", "mrcal-check", "mrcal-facts", "residual-tests",
    "residual-views", "residual-findings", "residual-boards", "outlier-replay", "uncertainty",
    "pinhole", "decisions", "ruler-trends", "ruler-acceptance", "sequence", "sequence-cycles",
    "extensometer-class", "gauge-outliers", "item", "statements", "budget", "diameter-budget",
    "noise-floor", "idics", "earlier", "changes", "changes-calibration"};
// clang-format on

const std::vector<std::string>& TableNames() {
  static const std::vector<std::string> kNames(std::begin(kTableNames), std::end(kTableNames));
  return kNames;
}

const std::vector<std::string>& ChartNames() {
  static const std::vector<std::string> kNames = {
      "residual-field",       "residual-histogram",
      "residual-scatter",     "ruler-errors",
      "strain-states",        "strain-gauges",
      "strain-errors",        "diagnosis-histogram",
      "diagnosis-lengths",    "diagnosis-directions",
      "regional-means",       "regional-deviations",
      "pinhole-rms",          "pinhole-ruler",
      "uncertainty-of-noise", "uncertainty-of-everything",
      "ruler-positions",      "ruler-depths",
      "strain-hysteresis",    "budget-bars"};
  return kNames;
}

const std::vector<std::string>& ConditionNames() {
  static const std::vector<std::string> kNames = {
      "calibration", "diagnosis", "pinhole", "ruler", "strain", "gauges", "sequence", "changes"};
  return kNames;
}

const std::map<std::string, Keys>& BlockTypes() {
  static const std::map<std::string, Keys> kTypes = {
      {"title",
       {{"text", {Kind::kText, true}},
        {"subtitle", {Kind::kText, false}},
        {"right", {Kind::kTexts, false}}}},
      {"verdict", {{"table", {Kind::kText, true}}}},
      {"heading", {{"text", {Kind::kText, true}}, {"level", {Kind::kNumber, false}}}},
      {"text", {{"text", {Kind::kText, true}}, {"style", {Kind::kText, false}}}},
      {"key-values",
       {{"table", {Kind::kText, true}},
        {"columns", {Kind::kNumber, false}},
        {"show_title", {Kind::kBool, false}}}},
      {"table",
       {{"table", {Kind::kText, true}},
        {"show_title", {Kind::kBool, false}},
        {"width_mm", {Kind::kNumber, false}},
        {"mono", {Kind::kTexts, false}},
        {"otherwise", {Kind::kText, false}}}},
      {"chart",
       {{"charts", {Kind::kTexts, true}},
        {"height_mm", {Kind::kNumber, true}},
        {"caption", {Kind::kText, false}}}},
      {"picture",
       {{"file", {Kind::kText, true}},
        {"caption", {Kind::kText, false}},
        {"otherwise", {Kind::kText, false}}}},
      {"signatures", {{"roles", {Kind::kTexts, true}}, {"note", {Kind::kText, false}}}},
      {"page-break", {}},
      {"end-mark", {{"text", {Kind::kText, true}}}}};
  return kTypes;
}

template <typename Map>
std::vector<std::string> NamesOf(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

// Collects the first thing that is wrong.
class Checker {
 public:
  explicit Checker(std::string name) : name_(std::move(name)) {}
  const std::optional<Error>& error() const { return error_; }

  void Fail(const std::string& pointer, const std::string& what) {
    if (!error_) error_ = BadInput(name_ + ": " + (pointer.empty() ? "/" : pointer) + ": " + what);
  }
  void CheckWord(const std::string& pointer, const Json& json,
                 const std::vector<std::string>& known, const std::string& noun) {
    if (!json.is_string()) return Fail(pointer, "must be the name of a " + noun);
    for (const std::string& word : known)
      if (json == word) return;
    Fail(pointer, "there is no " + noun + " '" + json.get<std::string>() + "'; did you mean '" +
                      NearestWord(json.get<std::string>(), known) + "'?");
  }
  void CheckKind(const std::string& pointer, const Json& json, Kind kind);
  void CheckBlock(const std::string& pointer, const Json& block);
  void CheckDocument(const Json& json);

 private:
  void CheckNames(const std::string& pointer, const Json& block);
  void CheckRanges(const std::string& pointer, const Json& block);
  std::string name_;
  std::optional<Error> error_;
};

void Checker::CheckKind(const std::string& pointer, const Json& json, Kind kind) {
  if (kind == Kind::kText && !json.is_string()) Fail(pointer, "must be a text");
  if (kind == Kind::kNumber && !json.is_number()) Fail(pointer, "must be a number");
  if (kind == Kind::kBool && !json.is_boolean()) Fail(pointer, "must be true or false");
  if (kind != Kind::kTexts) return;
  if (!json.is_array() || json.empty()) return Fail(pointer, "must be a list of texts");
  for (std::size_t i = 0; i < json.size(); ++i)
    CheckKind(pointer + "/" + std::to_string(i), json[i], Kind::kText);
}

void Checker::CheckNames(const std::string& pointer, const Json& block) {
  for (const char* key : {"when", "unless"})
    if (block.contains(key))
      CheckWord(pointer + "/" + key, block[key], ConditionNames(), "section");
  if (block.contains("table")) CheckWord(pointer + "/table", block["table"], TableNames(), "table");
  if (block.contains("charts"))
    for (std::size_t i = 0; i < block["charts"].size(); ++i)
      CheckWord(pointer + "/charts/" + std::to_string(i), block["charts"][i], ChartNames(),
                "chart");
  if (block.contains("style"))
    CheckWord(pointer + "/style", block["style"], {"body", "note", "strong"}, "style");
}

void Checker::CheckRanges(const std::string& pointer, const Json& block) {
  struct Range {
    const char* key;
    double low, high;
  };
  for (const Range& range : {Range{"height_mm", 20, 240}, Range{"width_mm", 30, 170},
                             Range{"columns", 1, 3}, Range{"level", 1, 2}}) {
    if (!block.contains(range.key) || !block[range.key].is_number()) continue;
    const double value = block[range.key].get<double>();
    if (!(value >= range.low && value <= range.high))
      Fail(pointer + "/" + range.key, "is " + FormatShortest(value) + ", allowed are " +
                                          FormatShortest(range.low) + " to " +
                                          FormatShortest(range.high));
  }
}

void Checker::CheckBlock(const std::string& pointer, const Json& block) {
  if (!block.is_object()) return Fail(pointer, "must be an object with a 'type'");
  if (!block.contains("type")) return Fail(pointer, "has no 'type'");
  CheckWord(pointer + "/type", block["type"], NamesOf(BlockTypes()), "block type");
  if (error_) return;
  const Keys& keys = BlockTypes().at(block["type"].get<std::string>());
  for (const auto& [key, rule] : keys)
    if (rule.required && !block.contains(key)) Fail(pointer, "needs the key '" + key + "'");
  std::vector<std::string> known = NamesOf(keys);
  known.insert(known.end(), {"type", "when", "unless"});
  for (const auto& [key, value] : block.items()) {
    if (keys.count(key))
      CheckKind(pointer + "/" + key, value, keys.at(key).kind);
    else
      CheckWord(pointer + "/" + key, Json(key), known, "key");
  }
  if (error_) return;
  CheckNames(pointer, block);
  CheckRanges(pointer, block);
}

void Checker::CheckDocument(const Json& json) {
  static const std::vector<std::string> kKeys = {"schema", "title",  "author", "header",
                                                 "footer", "labels", "blocks"};
  if (!json.is_object()) return Fail("", "must be an object");
  for (const auto& [key, value] : json.items()) CheckWord("/" + key, Json(key), kKeys, "key");
  if (TextAt(json, "/schema") != kSchema)
    Fail("/schema", "is '" + TextAt(json, "/schema", "none") + "', wanted '" + kSchema + "'");
  for (const char* side : {"/header/left", "/header/right", "/footer/left", "/footer/right"})
    if (const Json& text = EntryAt(json, side); !text.is_null()) CheckKind(side, text, Kind::kText);
  for (const char* key : {"title", "author"})
    if (json.contains(key)) CheckKind(std::string("/") + key, json[key], Kind::kText);
  const Json& labels = EntryAt(json, "/labels");
  if (labels.is_object())
    for (const auto& [key, value] : labels.items()) CheckKind("/labels/" + key, value, Kind::kText);
  if (ListAt(json, "/blocks").empty()) return Fail("/blocks", "must be a list of blocks");
  for (std::size_t i = 0; i < json["blocks"].size(); ++i)
    CheckBlock("/blocks/" + std::to_string(i), json["blocks"][i]);
}

// One {{…}} without its braces.
std::string FillOne(std::string content, const Json& values) {
  for (;;) {
    const std::size_t bar = content.find('|');
    const std::string alternative = content.substr(0, bar);
    if (alternative.empty() || alternative[0] != '/') return alternative;
    const std::string value = TextAt(values, alternative);
    if (!value.empty() || bar == std::string::npos) return value;
    content.erase(0, bar + 1);
  }
}

}  // namespace

Result<ReportTemplate> ReportTemplate::Parse(const std::string& name, const std::string& text) {
  ReportTemplate layout;
  try {
    layout.json_ = Json::parse(text);
  } catch (const nlohmann::json::exception& e) {
    return BadInput(name + ": is not valid JSON: " + e.what());
  }
  Checker checker(name);
  checker.CheckDocument(layout.json_);
  if (checker.error()) return *checker.error();
  return layout;
}

Result<ReportTemplate> ReportTemplate::BuiltIn() {
  return Parse("built-in acceptance.json", kBuiltInTemplate);
}

std::string ReportTemplate::Translate(const std::string& text) const {
  const Json& labels = EntryAt(json_, "/labels");
  if (!labels.is_object() || !labels.contains(text)) return text;
  return labels[text].get<std::string>();
}

std::string FillIn(const std::string& text, const Json& values) {
  std::string filled;
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = text.find("{{", at);
    const std::size_t close = open == std::string::npos ? open : text.find("}}", open);
    if (close == std::string::npos) return filled + text.substr(at);
    filled += text.substr(at, open - at) + FillOne(text.substr(open + 2, close - open - 2), values);
    at = close + 2;
  }
}

}  // namespace telestrain
