#include "viz/export/glb_buffer.h"

#include <Eigen/Geometry>

#include "viz/export/little_endian.h"

namespace telestrain::viz {
namespace {

using Json = nlohmann::ordered_json;

// glTF 2.0, section 3.6.2.2 and 5.11.5.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;

void AppendChunk(const char* type, const std::string& content, std::string* bytes) {
  AppendLittleEndian(static_cast<std::uint32_t>(content.size()), bytes);
  *bytes += std::string(type, 4) + content;
}

void Pad(char with, std::string* bytes) { bytes->resize((bytes->size() + 3) / 4 * 4, with); }

}  // namespace

std::size_t GlbBuffer::AddAccessor(std::size_t first_byte, std::size_t count, bool indices,
                                   const char* type) {
  views_.push_back({{"buffer", 0},
                    {"byteOffset", first_byte},
                    {"byteLength", bytes_.size() - first_byte},
                    {"target", indices ? kElementArrayBuffer : kArrayBuffer}});
  accessors_.push_back({{"bufferView", views_.size() - 1},
                        {"componentType", indices ? kUnsignedInt : kFloat},
                        {"count", count},
                        {"type", type}});
  return accessors_.size() - 1;
}

std::size_t GlbBuffer::AddVectors(const std::vector<Eigen::Vector3f>& vectors) {
  const std::size_t first = bytes_.size();
  for (const Eigen::Vector3f& vector : vectors)
    for (int i = 0; i < 3; ++i) AppendLittleEndian(vector[i], &bytes_);
  return AddAccessor(first, vectors.size(), false, "VEC3");
}

std::size_t GlbBuffer::AddPositions(const std::vector<Eigen::Vector3f>& positions_m) {
  const std::size_t index = AddVectors(positions_m);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& position : positions_m) box.extend(position);
  // As double, so that the text reads back to exactly the single-precision number in the buffer.
  for (const auto& [key, corner] : {std::pair{"min", box.min()}, {"max", box.max()}})
    accessors_[index][key] = {double(corner.x()), double(corner.y()), double(corner.z())};
  return index;
}

std::size_t GlbBuffer::AddScalars(const std::vector<double>& numbers) {
  const std::size_t first = bytes_.size();
  for (const double number : numbers) AppendLittleEndian(static_cast<float>(number), &bytes_);
  return AddAccessor(first, numbers.size(), false, "SCALAR");
}

std::size_t GlbBuffer::AddIndices(const std::vector<std::uint32_t>& indices) {
  const std::size_t first = bytes_.size();
  for (const std::uint32_t index : indices) AppendLittleEndian(index, &bytes_);
  return AddAccessor(first, indices.size(), true, "SCALAR");
}

void GlbBuffer::Describe(Json* json) const {
  (*json)["buffers"] = Json::array({Json{{"byteLength", bytes_.size()}}});
  (*json)["bufferViews"] = views_;
  (*json)["accessors"] = accessors_;
}

std::string GlbContainer(std::string json, std::string buffer) {
  Pad(' ', &json);
  Pad('\0', &buffer);
  constexpr std::uint32_t kVersion = 2, kHeaderBytes = 12, kChunkHeaderBytes = 8;
  const std::size_t total = kHeaderBytes + kChunkHeaderBytes + json.size() +
                            (buffer.empty() ? 0 : kChunkHeaderBytes + buffer.size());
  std::string bytes = "glTF";
  AppendLittleEndian(kVersion, &bytes);
  AppendLittleEndian(static_cast<std::uint32_t>(total), &bytes);
  AppendChunk("JSON", json, &bytes);
  if (!buffer.empty()) AppendChunk("BIN\0", buffer, &bytes);
  return bytes;
}

}  // namespace telestrain::viz
