#include "robustness/bad_input/damage.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace telestrain::testing_support {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

// The distance between those taken.
std::size_t Stride(std::size_t count, int sample) {
  if (IsLongForm()) return 1;
  return std::max<std::size_t>(1, count / static_cast<std::size_t>(sample));
}

void AddPointers(const Json& json, const Pointer& at, std::vector<Pointer>& pointers) {
  if (json.is_object())
    for (const auto& [key, value] : json.items()) {
      pointers.push_back(at / key);
      AddPointers(value, at / key, pointers);
    }
  if (json.is_array() && !json.empty()) {
    pointers.push_back(at / std::size_t{0});
    AddPointers(json[0], at / std::size_t{0}, pointers);
  }
}

Json Without(const Json& json, const Pointer& pointer) {
  Json changed = json;
  Json& parent = changed[pointer.parent_pointer()];
  if (parent.is_array())
    parent.erase(parent.begin());
  else
    parent.erase(pointer.back());
  return changed;
}

const std::vector<Json>& OtherValues() {
  static const std::vector<Json> values{nullptr,
                                        true,
                                        "x\x1b[31m/../y",
                                        -1,
                                        0,
                                        3000000000U,
                                        1e300,
                                        Json::array(),
                                        Json::object(),
                                        Json::array({Json::array({"a"})})};
  return values;
}

}  // namespace

bool IsLongForm() { return std::getenv("TELESTRAIN_ALL_DAMAGE") != nullptr; }

std::vector<Damaged> Truncations(const std::string& bytes, int sample) {
  std::vector<Damaged> all;
  for (std::size_t kept = 0; kept < bytes.size(); kept += Stride(bytes.size(), sample))
    all.push_back({"cut to " + std::to_string(kept) + " bytes", bytes.substr(0, kept)});
  return all;
}

std::vector<Damaged> Flips(const std::string& bytes, int sample) {
  constexpr std::string_view kClasses{"\0\x1b\n\"[\xff", 6};
  std::vector<Damaged> all;
  std::size_t turn = 0;
  for (std::size_t at = 0; at < bytes.size(); at += Stride(bytes.size(), sample), ++turn) {
    std::string changed = bytes;
    const std::size_t kind = turn % (kClasses.size() + 1);
    changed[at] = kind < kClasses.size() ? kClasses[kind] : static_cast<char>(changed[at] ^ '\x80');
    if (changed[at] != bytes[at])
      all.push_back({"byte " + std::to_string(at) + " changed, class " + std::to_string(kind),
                     std::move(changed)});
  }
  return all;
}

std::vector<Damaged> TomlDamages(const std::string& text) {
  constexpr const char* kValues[] = {"1e999", "nan",          "-1", "1979-05-27",
                                     "true",  "\"a\\u001b\"", "[]", "{a = 1}",
                                     "1,5",   "0x7fffffffff"};
  std::vector<Damaged> all;
  std::size_t begin = 0;
  for (std::size_t end; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::size_t equals = line.find(" = ");
    if (equals == std::string::npos || line.front() == '#') continue;
    const std::string key = line.substr(0, equals), rest = text.substr(end);
    const std::string before = text.substr(0, begin);
    all.push_back({"no " + key, before + "# " + line + rest});
    all.push_back({key + " twice", before + line + "\n" + line + rest});
    for (const char* value : kValues)
      all.push_back({key + " = " + value, before + key + " = " + value + rest});
  }
  return all;
}

std::vector<Damaged> JsonDamages(const Json& json, int sample) {
  std::vector<Pointer> pointers;
  AddPointers(json, Pointer(), pointers);
  std::vector<Damaged> all;
  const std::size_t kinds = OtherValues().size() + 1, count = kinds * pointers.size();
  std::size_t stride = Stride(count, sample);
  if (stride % kinds == 0) ++stride;  // else every entry would be changed in the same way
  for (std::size_t i = 0; i < count; i += stride) {
    const Pointer& pointer = pointers[i / kinds];
    if (i % kinds == 0) {
      all.push_back({"no " + pointer.to_string(), Without(json, pointer).dump(2)});
      continue;
    }
    Json changed = json;
    changed[pointer] = OtherValues()[i % kinds - 1];
    all.push_back({pointer.to_string() + " = " + changed[pointer].dump(), changed.dump(2)});
  }
  return all;
}

}  // namespace telestrain::testing_support
