#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace telestrain::viz::testing {

// A binary glTF file taken apart as its specification says (sections 3.6 and 4.4).
struct GlbContent {
  nlohmann::json json;
  std::string buffer;

  // The numbers of an accessor, `components` after each other per element.
  template <typename Number>
  std::vector<Number> Numbers(std::size_t accessor) const {
    const auto& entry = json["accessors"][accessor];
    const auto& view = json["bufferViews"][entry["bufferView"].get<std::size_t>()];
    const std::size_t components = entry["type"] == "VEC3" ? 3 : 1;
    std::vector<Number> numbers(entry["count"].get<std::size_t>() * components);
    EXPECT_EQ(view["byteLength"].get<std::size_t>(), numbers.size() * sizeof(Number));
    std::memcpy(numbers.data(), buffer.data() + view["byteOffset"].get<std::size_t>(),
                view["byteLength"].get<std::size_t>());
    return numbers;
  }

  // The node of that name; null when there is none.
  const nlohmann::json* Node(const std::string& name) const {
    for (const auto& node : json["nodes"])
      if (node["name"] == name) return &node;
    return nullptr;
  }
};

inline std::uint32_t Word(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

// Fails the test where the container is not as specified.
inline GlbContent OpenGlb(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(Word(bytes, 4), 2U);
  EXPECT_EQ(Word(bytes, 8), bytes.size());
  const std::size_t json_bytes = Word(bytes, 12), second = 20 + json_bytes;
  EXPECT_EQ(json_bytes % 4, 0U);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  GlbContent content{nlohmann::json::parse(bytes.substr(20, json_bytes)), ""};
  if (second == bytes.size()) return content;
  EXPECT_EQ(bytes.substr(second + 4, 4), std::string("BIN\0", 4));
  content.buffer = bytes.substr(second + 8);
  EXPECT_EQ(Word(bytes, second), content.buffer.size());
  EXPECT_EQ(content.buffer.size() % 4, 0U);
  return content;
}

}  // namespace telestrain::viz::testing
