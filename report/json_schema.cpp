#include "report/json_schema.h"

#include <optional>
#include <regex>
#include <set>
#include <vector>

#include "base/check.h"
#include "base/numbers.h"
#include "base/utf8.h"

namespace telestrain {
namespace {

const std::set<std::string> kRules = {"type",    "const",    "enum",      "minimum",
                                      "maximum", "pattern",  "required",  "exclusiveMinimum",
                                      "items",   "minItems", "maxItems",  "additionalProperties",
                                      "oneOf",   "$ref",     "properties"};
const std::set<std::string> kAnnotations = {"$schema", "$id",     "$comment", "$defs",
                                            "title",   "default", "examples", "description"};

bool HasType(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  TELESTRAIN_CHECK(type == "number", "a schema names an unknown type: " + type);
  return value.is_number();
}

std::string TypeInWords(const std::string& type) {
  if (type == "object") return "an object";
  if (type == "array") return "a list";
  if (type == "string") return "a text";
  if (type == "boolean") return "true or false";
  return type == "integer" ? "a whole number" : "a number";
}

// What was found, short enough for a line.
std::string Shown(const Json& value) {
  constexpr std::size_t kLongest = 60;
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list";
  if (value.is_string())
    return "'" + std::string(FirstCharacters(value.get<std::string>(), kLongest)) + "'";
  return value.dump();
}

std::string Nearest(const std::string& word, const std::vector<std::string>& known) {
  return known.empty() ? "" : "; did you mean '" + NearestWord(word, known) + "'?";
}

std::vector<std::string> KeysOf(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

class SchemaChecker {
 public:
  SchemaChecker(const Json& schema, std::string where)
      : schema_(schema), where_(std::move(where)) {}
  const std::optional<Error>& error() const { return error_; }
  void Check(const Json& rule, const std::string& pointer, const Json& value);

 private:
  void Fail(const std::string& pointer, const std::string& what) {
    if (!error_) error_ = BadInput(where_ + ": " + (pointer.empty() ? "/" : pointer) + ": " + what);
  }
  const Json& Resolve(const Json& rule) const;
  void CheckText(const Json& rule, const std::string& pointer, const Json& value);
  void CheckRange(const Json& rule, const std::string& pointer, const Json& value);
  void CheckObject(const Json& rule, const std::string& pointer, const Json& value);
  void CheckList(const Json& rule, const std::string& pointer, const Json& value);
  void CheckOneOf(const Json& rule, const std::string& pointer, const Json& value);
  bool IsMeant(const Json& alternative, const Json& value, std::vector<std::string>& types,
               std::vector<std::string>& keys) const;

  const Json& schema_;
  std::string where_;
  std::optional<Error> error_;
};

const Json& SchemaChecker::Resolve(const Json& rule) const {
  const std::string reference = TextAt(rule, "/$ref");
  if (reference.empty()) return rule;
  const Json& found = EntryAt(schema_, reference.substr(1));
  TELESTRAIN_CHECK(reference[0] == '#' && found.is_object(), "a schema refers to " + reference);
  return &found == &rule ? rule : Resolve(found);
}

void SchemaChecker::CheckText(const Json& rule, const std::string& pointer, const Json& value) {
  const std::string noun = TextAt(rule, "/title", "word"), word = TextAt(value, "");
  if (rule.contains("const") && value != rule["const"])
    Fail(pointer, "is " + Shown(value) + ", wanted " + Shown(rule["const"]));
  if (const Json& words = ListAt(rule, "/enum"); !words.empty()) {
    for (const Json& known : words)
      if (known == value) return;
    Fail(pointer, "there is no " + noun + " " + Shown(value) +
                      Nearest(word, words.get<std::vector<std::string>>()));
  }
  if (!rule.contains("pattern") || !value.is_string()) return;
  // std::regex calls itself for every character, so a long word would run out of stack.
  constexpr std::size_t kLongestWord = 200;
  if (word.size() > kLongestWord)
    return Fail(pointer, "has " + std::to_string(word.size()) + " bytes, a " + noun +
                             " has at most " + std::to_string(kLongestWord));
  if (!std::regex_search(word, std::regex(rule["pattern"].get<std::string>())))
    Fail(pointer, "is " + Shown(value) + ", wanted a " + noun);
}

void SchemaChecker::CheckRange(const Json& rule, const std::string& pointer, const Json& value) {
  const auto low = NumberAt(rule, "/minimum"), high = NumberAt(rule, "/maximum"),
             above = NumberAt(rule, "/exclusiveMinimum"), number = NumberAt(value, "");
  if (!number) return;
  const std::string is = "is " + FormatShortest(*number) + ", allowed ";
  if (above && !(*number > *above)) Fail(pointer, is + "is more than " + FormatShortest(*above));
  if ((low && *number < *low) || (high && *number > *high))
    Fail(pointer, is + (low && high ? "are " + FormatShortest(*low) + " to " + FormatShortest(*high)
                        : low       ? "is at least " + FormatShortest(*low)
                                    : "is at most " + FormatShortest(*high)));
}

void SchemaChecker::CheckObject(const Json& rule, const std::string& pointer, const Json& value) {
  const Json& properties = EntryAt(rule, "/properties");
  const Json& others = EntryAt(rule, "/additionalProperties");
  for (const Json& key : ListAt(rule, "/required"))
    if (!value.contains(key.get<std::string>()))
      Fail(pointer, "needs the key '" + key.get<std::string>() + "'");
  for (const auto& [key, entry] : value.items()) {
    const std::string below = pointer + "/" + PointerStep(key);
    if (properties.is_object() && properties.contains(key))
      Check(properties[key], below, entry);
    else if (others.is_object())
      Check(others, below, entry);
    else if (others == false)
      Fail(below, "there is no key '" + key + "'" +
                      Nearest(key, properties.is_object() ? KeysOf(properties)
                                                          : std::vector<std::string>{}));
  }
}

void SchemaChecker::CheckList(const Json& rule, const std::string& pointer, const Json& value) {
  const double size = static_cast<double>(value.size());
  const double least = NumberAt(rule, "/minItems").value_or(0);
  const double most = NumberAt(rule, "/maxItems").value_or(size);
  if (size < least || size > most)
    Fail(pointer, "has " + FormatShortest(size) + " entries, wanted " +
                      (size < least ? "at least " + FormatShortest(least)
                                    : "at most " + FormatShortest(most)));
  if (rule.contains("items"))
    for (std::size_t i = 0; i < value.size(); ++i)
      Check(rule["items"], pointer + "/" + std::to_string(i), value[i]);
}

// Whether `value` is meant to be this alternative of a oneOf; collects what it could say instead.
bool SchemaChecker::IsMeant(const Json& alternative, const Json& value,
                            std::vector<std::string>& types, std::vector<std::string>& keys) const {
  const Json& constant = EntryAt(alternative, "/properties/type/const");
  if (constant.is_string()) {
    types.push_back(constant.get<std::string>());
    return value.contains("type") && value["type"] == constant;
  }
  for (const Json& key : ListAt(alternative, "/required")) {
    keys.push_back(key.get<std::string>());
    if (!value.contains(keys.back())) return false;
  }
  return !value.contains("type");
}

void SchemaChecker::CheckOneOf(const Json& rule, const std::string& pointer, const Json& value) {
  const std::string noun = TextAt(rule, "/title", "entry");
  if (!value.is_object()) return Fail(pointer, "is " + Shown(value) + ", must be an object");
  std::vector<std::string> types, keys;
  for (const Json& reference : rule["oneOf"]) {
    const Json& alternative = Resolve(reference);
    if (IsMeant(alternative, value, types, keys)) return Check(alternative, pointer, value);
  }
  std::string other;
  for (const std::string& key : keys) other += " or '" + key + "'";
  if (!value.contains("type")) return Fail(pointer, "has no 'type'" + other);
  Fail(pointer + "/type",
       "there is no " + noun + " " + Shown(value["type"]) + Nearest(TextAt(value, "/type"), types));
}

void SchemaChecker::Check(const Json& reference, const std::string& pointer, const Json& value) {
  const Json& rule = Resolve(reference);
  for (const auto& [key, entry] : rule.items())
    TELESTRAIN_CHECK(kRules.count(key) || kAnnotations.count(key),
                     "a schema has an unknown rule: " + key);
  if (const std::string type = TextAt(rule, "/type"); !type.empty() && !HasType(value, type))
    return Fail(pointer, "is " + Shown(value) + ", must be " + TypeInWords(type));
  CheckText(rule, pointer, value);
  CheckRange(rule, pointer, value);
  if (rule.contains("oneOf")) CheckOneOf(rule, pointer, value);
  if (value.is_object()) CheckObject(rule, pointer, value);
  if (value.is_array()) CheckList(rule, pointer, value);
}

}  // namespace

Status CheckAgainstSchema(const Json& schema, const std::string& part, const std::string& where,
                          const Json& value) {
  SchemaChecker checker(schema, where);
  Json rule;
  rule["$ref"] = part;
  checker.Check(rule, "", value);
  if (checker.error()) return *checker.error();
  return {};
}

std::string PointerStep(const std::string& key) {
  std::string step;
  for (const char c : key) step += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return step;
}

}  // namespace telestrain
