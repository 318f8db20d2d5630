#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace telestrain::testing_support {

// A file as an attacker, a full disk or a text editor leaves it.
struct Damaged {
  std::string what;  // for the message of a failed test
  std::string bytes;
};

// Whether TELESTRAIN_ALL_DAMAGE is set: every offset and every key instead of a sample.
bool IsLongForm();

// `sample`: how many of them the short form takes, spread evenly over the whole; the long form
// takes all.
std::vector<Damaged> Truncations(const std::string& bytes, int sample);
// One byte replaced, at each offset by another class: zero, escape, line feed, quote, bracket, not
// UTF-8, the highest bit turned.
std::vector<Damaged> Flips(const std::string& bytes, int sample);
// Every `key = value` line of a TOML text removed, doubled, and with a value of every other kind.
// Of a line that is removed `what` begins with "no ".
std::vector<Damaged> TomlDamages(const std::string& text);
// Every entry of a JSON value (of arrays the first one) removed and replaced by every other kind of
// value and by numbers that are none, negative and huge.
std::vector<Damaged> JsonDamages(const nlohmann::ordered_json& json, int sample);

}  // namespace telestrain::testing_support
