#include "report/json_schema.h"

#include <gtest/gtest.h>

namespace telestrain {
namespace {

// The message for `value` against `rule`; empty when it is right.
std::string Fault(const Json& rule, const Json& value) {
  const Status status = CheckAgainstSchema(rule, "#", "file.json", value);
  return status ? "" : status.error().message;
}

TEST(JsonSchema, EveryRuleRejectsWhatBreaksItAndNamesPlaceAndRemedy) {
  struct Case {
    const char *rule, *right, *wrong, *message;
  };
  const Case cases[] = {
      {R"({"type": "object"})", "{}", "[]", "/: is a list, must be an object"},
      {R"({"type": "integer"})", "3", "3.5", "/: is 3.5, must be a whole number"},
      {R"({"type": "boolean"})", "true", "1", "must be true or false"},
      {R"({"const": "a"})", R"("a")", R"("b")", "/: is 'b', wanted 'a'"},
      {R"({"title": "chart", "enum": ["ruler-errors", "pipe"]})", R"("pipe")", R"("ruler-eror")",
       "there is no chart 'ruler-eror'; did you mean 'ruler-errors'?"},
      {R"({"minimum": 2, "maximum": 4})", "4", "4.5", "/: is 4.5, allowed are 2 to 4"},
      {R"({"minimum": 2})", "2", "1", "allowed is at least 2"},
      {R"({"maximum": 2})", "2", "3", "allowed is at most 2"},
      {R"({"exclusiveMinimum": 0})", "0.1", "0", "/: is 0, allowed is more than 0"},
      {R"({"title": "colour like #14324F", "pattern": "^#[0-9A-F]{6}$"})", R"("#00FF00")",
       R"("#00FF0")", "is '#00FF0', wanted a colour like #14324F"},
      {R"({"required": ["text"]})", R"({"text": 1})", R"({"txt": 1})", "/: needs the key 'text'"},
      {R"({"properties": {"a/b": {"type": "string"}}})", R"({"a/b": "x"})", R"({"a/b": 1})",
       "/a~1b: is 1, must be a text"},
      {R"({"properties": {"level": {}}, "additionalProperties": false})", R"({"level": 1})",
       R"({"levle": 1})", "/levle: there is no key 'levle'; did you mean 'level'?"},
      {R"({"additionalProperties": {"type": "number"}})", R"({"x": 1})", R"({"x": "1"})",
       "/x: is '1', must be a number"},
      {R"({"items": {"type": "string"}})", R"(["a"])", R"(["a", 2])", "/1: is 2, must be a text"},
      {R"({"minItems": 1})", "[1]", "[]", "has 0 entries, wanted at least 1"},
      {R"({"maxItems": 1})", "[1]", "[1, 2]", "has 2 entries, wanted at most 1"},
  };
  for (const Case& c : cases) {
    const Json rule = Json::parse(c.rule);
    EXPECT_EQ(Fault(rule, Json::parse(c.right)), "") << c.rule;
    EXPECT_NE(Fault(rule, Json::parse(c.wrong)).find(c.message), std::string::npos)
        << c.rule << ": " << Fault(rule, Json::parse(c.wrong));
  }
}

// A matcher that calls itself for every character ran out of stack here.
TEST(JsonSchema, AWordOfAnyLengthIsRefusedAndNotMatched) {
  const Json rule = Json::parse(R"({"title": "name", "pattern": "^[^/]+[.]png$"})");
  EXPECT_EQ(Fault(rule, std::string(150, 'a') + ".png"), "");
  EXPECT_NE(Fault(rule, std::string(1 << 20, 'a') + ".png").find("at most 200"), std::string::npos);
}

TEST(JsonSchema, ChoosesTheAlternativeByItsTypeOrItsKeys) {
  const Json rule = Json::parse(R"({
    "title": "block type",
    "oneOf": [{"$ref": "#/$defs/include"}, {"$ref": "#/$defs/table"}, {"$ref": "#/$defs/text"}],
    "$defs": {
      "include": {"required": ["include"], "properties": {"include": {"type": "string"}}},
      "table": {"properties": {"type": {"const": "table"}, "rows": {"type": "integer"}}},
      "text": {"properties": {"type": {"const": "text"}, "rows": {"type": "string"}}}}})");
  EXPECT_EQ(Fault(rule, {{"type", "table"}, {"rows", 3}}), "");
  EXPECT_EQ(Fault(rule, {{"type", "text"}, {"rows", "3"}}), "");
  EXPECT_EQ(Fault(rule, {{"include", "x"}}), "");
  EXPECT_NE(Fault(rule, {{"type", "table"}, {"rows", "3"}}).find("/rows: is '3', must be a whole"),
            std::string::npos);
  EXPECT_NE(Fault(rule, {{"type", "tabel"}})
                .find("/type: there is no block type 'tabel'; did you mean 'table'?"),
            std::string::npos);
  EXPECT_NE(Fault(rule, {{"rows", 3}}).find("/: has no 'type' or 'include'"), std::string::npos);
  EXPECT_NE(Fault(rule, 3).find("must be an object"), std::string::npos);
}

// A rule that the interpreter does not know must not be taken for a rule that is met.
TEST(JsonSchema, AnUnknownRuleIsADefectOfTheSchema) {
  for (const char* rule :
       {R"({"maxLength": 3})", R"({"type": "texts"})", R"({"$ref": "#/$defs/none"})"})
    EXPECT_THROW(Fault(Json::parse(rule), "text"), std::logic_error) << rule;
}

}  // namespace
}  // namespace telestrain
