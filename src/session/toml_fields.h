#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "session/toml_tree.h"

namespace telestrain {

// Reading a TOML table from a list of its fields. The list is the one place that says which keys
// exist, which are required, what their values may be and where they go; the checks of types and
// ranges, unknown keys (with the nearest known one) and missing keys all come from it.

// Reads a value that is there. `wanted` says in words what it may be, for errors.
struct FieldReader {
  std::string wanted;
  std::function<Status(const TomlNode&)> read;
};

struct TomlField {
  std::string key;
  bool required = false;
  FieldReader reader;
};

inline TomlField Required(std::string key, FieldReader reader) {
  return {std::move(key), true, std::move(reader)};
}
inline TomlField Optional(std::string key, FieldReader reader) {
  return {std::move(key), false, std::move(reader)};
}

// Limits of a number, both inclusive unless `above_min`.
struct NumberRange {
  double min = 0;
  double max = 0;
  bool above_min = false;
  std::string Words() const;
  bool Contains(double value) const {
    return (above_min ? value > min : value >= min) && value <= max;
  }
};

inline NumberRange From(double min, double max) { return {min, max, false}; }
inline NumberRange Above(double min, double max) { return {min, max, true}; }

// Readers. Each keeps a reference to where the value goes; integers are taken as numbers too.
FieldReader Number(double& into, NumberRange range);
FieldReader Number(std::optional<double>& into, NumberRange range);
FieldReader Whole(int& into, NumberRange range);
FieldReader Text(std::string& into);  // not empty, one line
FieldReader OneOf(int& index_into, std::vector<std::string> choices);
FieldReader Point(Eigen::Vector3d& into);  // mm
FieldReader Point(std::optional<Eigen::Vector3d>& into);
// A unit vector within 2 %; normalised, unless it is one already to rounding.
FieldReader Direction(Eigen::Vector3d& into);
FieldReader Direction(std::optional<Eigen::Vector3d>& into);
FieldReader Wholes4(Eigen::Vector4i& into, NumberRange range);
FieldReader Table(std::vector<TomlField> fields);
// Every item of an array of tables goes through `read_item`; the array may be empty. `example`
// shows in errors how such a table begins.
FieldReader Tables(std::string example, std::function<Status(const TomlNode&)> read_item);

// Reads every field of `table`. Fails (kBadInput) on the first key that is unknown, missing or has
// a value that its reader refuses, with file:line and remedy.
Status ReadFields(const TomlNode& table, const std::vector<TomlField>& fields);

// "folder/session.toml:31: view[2].name is 3, wanted a text; correct the value".
Error WrongValue(const TomlNode& node, const std::string& wanted);

}  // namespace telestrain
