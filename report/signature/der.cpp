#include "report/signature/der.h"

#include <algorithm>

namespace telestrain {
namespace {

constexpr unsigned char kLongLength = 0x80;
constexpr std::size_t kMostLengthBytes = 3;

unsigned char ByteAt(std::string_view bytes, std::size_t index) {
  return static_cast<unsigned char>(bytes[index]);
}

// How many bytes tag and length take, and the content; 0 and 0 when they are malformed.
struct Sizes {
  std::size_t header = 0, content = 0;
};

Sizes SizesOf(std::string_view bytes) {
  if (bytes.size() < 2) return {};
  const unsigned char first = ByteAt(bytes, 1);
  if (first < kLongLength) return {2, first};
  const std::size_t count = first & 0x7F;
  if (count == 0 || count > kMostLengthBytes || bytes.size() < 2 + count) return {};
  std::size_t content = 0;
  for (std::size_t i = 0; i < count; ++i) content = content << 8 | ByteAt(bytes, 2 + i);
  return {2 + count, content};
}

}  // namespace

std::string Der(unsigned char tag, std::string_view content) {
  std::string bytes(1, static_cast<char>(tag));
  std::string length;
  for (std::size_t rest = content.size(); rest > 0; rest >>= 8)
    length.insert(length.begin(), static_cast<char>(rest & 0xFF));
  if (content.size() < kLongLength)
    bytes += static_cast<char>(content.size());
  else
    bytes += static_cast<char>(kLongLength | length.size()) + length;
  return bytes.append(content);
}

std::string DerSetOf(unsigned char tag, std::vector<std::string> members) {
  // Unsigned bytes, as char_traits<char> compares them.
  std::sort(members.begin(), members.end());
  std::string content;
  for (const std::string& member : members) content += member;
  return Der(tag, content);
}

std::size_t DerLength(std::string_view bytes) {
  const Sizes sizes = SizesOf(bytes);
  const std::size_t whole = sizes.header + sizes.content;
  return sizes.header == 0 || whole > bytes.size() ? 0 : whole;
}

std::optional<std::vector<DerNode>> DerChildren(std::string_view content) {
  std::vector<DerNode> nodes;
  while (!content.empty()) {
    const std::size_t whole = DerLength(content);
    if (whole == 0) return std::nullopt;
    const std::size_t header = SizesOf(content).header;
    nodes.push_back(
        {ByteAt(content, 0), content.substr(0, whole), content.substr(header, whole - header)});
    content.remove_prefix(whole);
  }
  return nodes;
}

std::optional<DerNode> ReadDer(std::string_view bytes) {
  auto nodes = DerChildren(bytes);
  if (!nodes || nodes->size() != 1) return std::nullopt;
  return nodes->front();
}

}  // namespace telestrain
