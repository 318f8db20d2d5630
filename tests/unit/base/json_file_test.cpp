#include "base/json_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "tests/unit/base/scratch_folder.h"

namespace telestrain {
namespace {

constexpr char kSchema[] = "telestrain.test/1";

std::string MessageOf(const std::filesystem::path& path) {
  const auto json = ReadJson(path, kSchema, "telestrain make");
  EXPECT_FALSE(json.ok());
  return json ? "" : json.error().message;
}

TEST(JsonFileTest, KeepsOrderAndDoubles) {
  const ScratchFolder folder("json_order");
  nlohmann::ordered_json json;
  json["schema"] = kSchema;
  json["z"] = 0.1 + 0.2;
  json["a"] = {1.0 / 3.0, 1e-300, -0.0};
  ASSERT_TRUE(WriteJson(folder.path() / "f.json", json).ok());
  const auto again = ReadJson(folder.path() / "f.json", kSchema, "telestrain make");
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(*again, json);
  EXPECT_EQ(JsonText(*again), JsonText(json));
  EXPECT_LT(JsonText(json).find("\"z\""), JsonText(json).find("\"a\""));
  EXPECT_TRUE(JsonText(json).ends_with("}\n"));
}

TEST(JsonFileTest, ErrorsSayWhatMakesTheFile) {
  const ScratchFolder folder("json_errors");
  const auto path = folder.path() / "f.json";
  EXPECT_NE(MessageOf(path).find("does not exist; run 'telestrain make' first"), std::string::npos);
  ASSERT_TRUE(WriteFileAtomically(path, "{\"schema\": ").ok());
  EXPECT_NE(MessageOf(path).find("is not valid JSON"), std::string::npos);
  for (const char* text : {"{\"schema\": \"telestrain.test/2\"}", "{}", "[1]", "3"}) {
    ASSERT_TRUE(WriteFileAtomically(path, text).ok());
    EXPECT_NE(MessageOf(path).find("wanted 'telestrain.test/1'"), std::string::npos) << text;
  }
  ASSERT_TRUE(WriteFileAtomically(path, "{\"schema\": 3}").ok());
  EXPECT_NE(MessageOf(path).find("telestrain make"), std::string::npos);
}

TEST(JsonFileTest, DeepBracketsAreRefusedBeforeTheyCostTheStack) {
  const ScratchFolder folder("json_deep");
  const std::string open(1000000, '['), close(1000000, ']');
  ASSERT_TRUE(
      WriteFileAtomically(folder.path() / "f.json", "{\"schema\": " + open + close + "}").ok());
  EXPECT_NE(MessageOf(folder.path() / "f.json").find("nested deeper than 200"), std::string::npos);
  EXPECT_TRUE(CheckJsonText("{\"a\\\"[[[[\": [\"[[[[\"]}", 2).ok());
  EXPECT_EQ(CheckJsonText("{\"a\": [[]]}", 2).error().message, "is nested deeper than 2 brackets");
  EXPECT_TRUE(CheckJsonText("[[], [[]], []]", 3).ok());
}

TEST(JsonFileTest, WhatStandsBehindAZeroByteIsNotOverlooked) {
  EXPECT_EQ(ParseJson(std::string_view("[1]\0[2]", 7)).error().message,
            "is not valid JSON: the byte at offset 3 is zero");
}

TEST(JsonFileTest, TheLibrarysTagIsNotShown) {
  EXPECT_EQ(ParseJson("{\"a\": }").error().message.find("is not valid JSON: parse error at line 1"),
            0u);
}

TEST(JsonFileTest, NumbersOfWhichProductsWouldOverflowAreRefused) {
  EXPECT_EQ(ParseJson("{\"a\": [1e100, -2e100]}").error().message,
            "the number -2e+100 is larger than any that is measured, 1e+100");
  EXPECT_TRUE(ParseJson("[1e100, 1e-300, 18446744073709551615]").ok());
}

TEST(JsonFileTest, WhatIsNotUtf8IsMarked) {
  EXPECT_EQ(JsonText({{"file", "c\xff.vnl"}}), "{\n  \"file\": \"c\xef\xbf\xbd.vnl\"\n}\n");
}

TEST(JsonFileTest, APathThatCannotBeAskedForIsBadInput) {
  const ScratchFolder folder("json_paths");
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "file", "x").ok());
  for (const auto& path : {folder.path() / std::string(5000, 'x'), folder.path() / "loop",
                           folder.path() / "file" / "f.json"}) {
    const auto json = ReadJson(path, kSchema, "telestrain make");
    ASSERT_FALSE(json.ok());
    EXPECT_EQ(json.error().kind, ErrorKind::kBadInput);
    EXPECT_NE(json.error().message.find("telestrain make"), std::string::npos);
  }
}

}  // namespace
}  // namespace telestrain
