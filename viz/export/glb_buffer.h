#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace telestrain::viz {

// The one buffer of a binary glTF file with its views and accessors (glTF 2.0, sections 3.6.1 and
// 3.6.2). Everything in it is four bytes wide, so every offset is aligned. Each Add returns the
// index of the new accessor.
class GlbBuffer {
 public:
  std::size_t AddPositions(const std::vector<Eigen::Vector3f>& positions_m);  // with min and max
  std::size_t AddVectors(const std::vector<Eigen::Vector3f>& vectors);
  std::size_t AddScalars(const std::vector<double>& numbers);  // to single precision
  std::size_t AddIndices(const std::vector<std::uint32_t>& indices);

  const std::string& bytes() const { return bytes_; }
  // Adds `buffers`, `bufferViews` and `accessors`.
  void Describe(nlohmann::ordered_json* json) const;

 private:
  std::size_t AddAccessor(std::size_t first_byte, std::size_t count, bool indices,
                          const char* type);

  std::string bytes_;
  nlohmann::ordered_json views_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
};

// Header and chunks (section 4.4): the JSON text padded with blanks, the buffer with zeros, to
// multiples of four bytes. Without a buffer there is no second chunk.
std::string GlbContainer(std::string json, std::string buffer);

}  // namespace telestrain::viz
