#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>

namespace telestrain::viz {

// A value that a results file does not hold as promised; what() names it, e.g.
// "views[2].axis_in_array: 3 numbers are wanted, found [1,0]".
struct BadField : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A place inside a JSON file that knows its own name. Every access checks and throws BadField.
// Holds a pointer: the document must outlive it.
class JsonNode {
 public:
  explicit JsonNode(const nlohmann::ordered_json& json, std::string name = "");

  JsonNode At(const std::string& key) const;
  JsonNode At(int index) const;
  bool Has(const std::string& key) const;  // present and not null
  int Size() const;                        // of a list

  double Number() const;    // finite
  double Positive() const;  // finite and > 0
  bool Flag() const;
  double NumberOr(const std::string& key, double fallback) const;  // of a member, if it is there
  int Count() const;                                               // a whole number >= 0
  std::string Text() const;
  Eigen::Vector3d Vector3() const;
  Eigen::Vector3d Direction() const;  // of length 1 within 1e-6, as our own files have it
  Eigen::Matrix3d Rotation() const;   // nine numbers, row by row, orthonormal within 1e-6

  // For a rule of the caller's own: throws with the name, what is wanted and what was found.
  [[noreturn]] void Fail(const std::string& wanted) const;

 private:
  const nlohmann::ordered_json* json_;
  std::string name_;
};

}  // namespace telestrain::viz
