#include "robustness/fuzz/json_mutation.h"

#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "robustness/fuzz/fuzz_target.h"

namespace telestrain::fuzz {
namespace {

using Json = nlohmann::ordered_json;
using Random = std::mt19937_64;

// From `begin` to `end` of the input: a file, or a line of one.
struct Part {
  std::size_t begin = 0, end = 0;
};

std::vector<Part> PartsThatLookLikeJson(const std::string& input) {
  std::vector<Part> parts;
  std::size_t begin = 0;
  while (begin < input.size()) {
    if (input.compare(begin, kFileMark.size(), kFileMark) == 0)
      begin = std::min(input.find('\n', begin), input.size() - 1) + 1;
    std::size_t end = input.find("\n" + std::string(kFileMark), begin);
    end = end == std::string::npos ? input.size() : end + 1;
    if (begin < end && (input[begin] == '{' || input[begin] == '[')) parts.push_back({begin, end});
    begin = end;
  }
  return parts;
}

void Collect(Json& json, std::vector<Json*>& nodes) {
  nodes.push_back(&json);
  if (json.is_structured())
    for (Json& child : json) Collect(child, nodes);
}

Json Unlikely(Random& random) {
  static const std::vector<Json> values{nullptr,
                                        true,
                                        false,
                                        0,
                                        -1,
                                        1,
                                        2,
                                        3,
                                        1e308,
                                        -1e308,
                                        5e-324,
                                        -0.0,
                                        1e16,
                                        2147483647,
                                        -2147483648LL,
                                        9223372036854775807LL,
                                        4294967296LL,
                                        "",
                                        "a",
                                        "\n",
                                        "\xE2\x80\xAE",
                                        "1e999",
                                        "{{",
                                        "{{a}}",
                                        "../x",
                                        "/",
                                        "%n",
                                        std::string(1, '\0'),
                                        std::string(300, 'x'),
                                        "<&>\"'",
                                        "2026-01-31",
                                        Json::array(),
                                        Json::object(),
                                        Json::array({1}),
                                        Json::object({{"", 1}}),
                                        Json::array({nullptr, nullptr, nullptr}),
                                        Json::object({{"printed", {{"text", "x"}}}})};
  return values[random() % values.size()];
}

void ChangeMember(Json& json, Random& random) {
  const std::size_t size = json.size();
  const auto at = [&] {
    return std::next(json.begin(), static_cast<std::ptrdiff_t>(random() % size));
  };
  switch (random() % 5) {
    case 0:
      json.erase(at());
      break;
    case 1:
      std::swap(*at(), *at());
      break;
    case 2:
      *at() = Json(*at());
      break;
    case 3:
      if (json.is_array()) json.push_back(Json(*at()));
      break;
    default:
      *at() = Unlikely(random);
  }
}

void Change(Json& json, Random& random) {
  std::vector<Json*> nodes;
  Collect(json, nodes);
  Json& node = *nodes[random() % nodes.size()];
  if (node.is_structured() && !node.empty())
    ChangeMember(node, random);
  else if (node.is_number() && random() % 2 == 0)
    node = node.get<double>() * (static_cast<double>(random() % 2001) / 500 - 2);
  else
    node = random() % 4 == 0 ? Json(*nodes[random() % nodes.size()]) : Unlikely(random);
}

}  // namespace

std::optional<std::string> MutateJson(const std::string& input, std::uint64_t seed) {
  Random random(seed);
  const std::vector<Part> parts = PartsThatLookLikeJson(input);
  if (parts.empty()) return std::nullopt;
  const Part part = parts[random() % parts.size()];
  Json json = Json::parse(input.substr(part.begin, part.end - part.begin), nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  for (std::uint64_t i = random() % 3 + 1; i > 0; --i) Change(json, random);
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  return input.substr(0, part.begin) + text + input.substr(part.end);
}

}  // namespace telestrain::fuzz
