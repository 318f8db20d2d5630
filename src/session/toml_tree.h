#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

// One value of a TOML file together with the place where it stands, so that every complaint about
// it can begin with file:line. A tree of ours keeps the TOML library inside one source file.
struct TomlNode {
  enum class Kind { kTable, kArray, kText, kInteger, kFloat, kBoolean, kDate };

  Kind kind = Kind::kTable;
  std::string key;    // its own key; empty for items of arrays and the root
  std::string path;   // keys from the root, "view[2].region_px" (arrays count from 1)
  std::string place;  // "folder/session.toml:31: "
  std::string text;   // of kText the value, of the other scalars how to write it in a message
  double number = 0;  // of kInteger and kFloat; not finite when the file says inf or nan
  std::vector<TomlNode> children;  // of kTable in the order of the file, of kArray the items

  const TomlNode* Find(const std::string& child_key) const;
  // How the value is quoted in an error: "'text'", "3", "an array of 2 values", "a table".
  std::string Shown() const;
};

// A double as TOML writes it: reads back to the same value and shows a point or an exponent.
std::string TomlFloat(double value);

// `file` is the name used in errors. Fails (kBadInput) with line and column where it is no TOML.
Result<TomlNode> ParseToml(const std::string& file, const std::string& text);

}  // namespace telestrain
