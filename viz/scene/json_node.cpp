#include "viz/scene/json_node.h"

#include <Eigen/LU>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/utf8.h"

namespace telestrain::viz {
namespace {

constexpr double kUnitTolerance = 1e-6;  // our files carry all digits of a double

}  // namespace

JsonNode::JsonNode(const nlohmann::ordered_json& json, std::string name)
    : json_(&json), name_(std::move(name)) {}

void JsonNode::Fail(const std::string& wanted) const {
  std::string found = json_->dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  constexpr std::size_t kLongestExcerpt = 60;
  if (found.size() > kLongestExcerpt) {
    found.resize(FirstCharacters(found, kLongestExcerpt).size());
    found += "...";
  }
  throw BadField((name_.empty() ? "the file" : name_) + ": " + wanted + ", found " + found);
}

JsonNode JsonNode::At(const std::string& key) const {
  const std::string name = name_.empty() ? key : name_ + "." + key;
  if (!json_->is_object()) Fail("an object is wanted");
  const auto found = json_->find(key);
  if (found == json_->end()) throw BadField(name + ": is missing");
  return JsonNode(*found, name);
}

JsonNode JsonNode::At(int index) const {
  if (index >= Size()) Fail("a list of more than " + std::to_string(index) + " is wanted");
  return JsonNode((*json_)[static_cast<std::size_t>(index)],
                  name_ + "[" + std::to_string(index) + "]");
}

bool JsonNode::Has(const std::string& key) const {
  if (!json_->is_object()) Fail("an object is wanted");
  const auto found = json_->find(key);
  return found != json_->end() && !found->is_null();
}

int JsonNode::Size() const {
  if (!json_->is_array()) Fail("a list is wanted");
  return static_cast<int>(json_->size());
}

double JsonNode::Number() const {
  if (!json_->is_number()) Fail("a number is wanted");
  const double value = json_->get<double>();
  if (!std::isfinite(value)) Fail("a finite number is wanted");
  return value;
}

double JsonNode::Positive() const {
  const double value = Number();
  if (value <= 0) Fail("a number above 0 is wanted");
  return value;
}

bool JsonNode::Flag() const {
  if (!json_->is_boolean()) Fail("true or false is wanted");
  return json_->get<bool>();
}

double JsonNode::NumberOr(const std::string& key, double fallback) const {
  return Has(key) ? At(key).Number() : fallback;
}

int JsonNode::Count() const {
  if (!json_->is_number_integer() || *json_ < 0 || *json_ > 1'000'000'000)
    Fail("a whole number from 0 to 1000000000 is wanted");
  return json_->get<int>();
}

std::string JsonNode::Text() const {
  if (!json_->is_string()) Fail("a text is wanted");
  return json_->get<std::string>();
}

Eigen::Vector3d JsonNode::Vector3() const {
  if (!json_->is_array() || json_->size() != 3) Fail("3 numbers are wanted");
  return {At(0).Number(), At(1).Number(), At(2).Number()};
}

Eigen::Vector3d JsonNode::Direction() const {
  const Eigen::Vector3d vector = Vector3();
  if (std::abs(vector.norm() - 1) > kUnitTolerance) Fail("a direction of length 1 is wanted");
  return vector;
}

Eigen::Matrix3d JsonNode::Rotation() const {
  if (!json_->is_array() || json_->size() != 9) Fail("9 numbers, row by row, are wanted");
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = At(i).Number();
  const Eigen::Matrix3d product = matrix * matrix.transpose();
  if (!product.isIdentity(kUnitTolerance) || matrix.determinant() < 0)
    Fail("a rotation matrix is wanted");
  return matrix;
}

}  // namespace telestrain::viz
