#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace telestrain {

inline constexpr std::uint32_t kTiffShort = 3, kTiffLong = 4;  // types of a tag's value

// `count` bytes (up to 4) at `at` as an unsigned number; 0 where they reach beyond the end.
inline std::uint32_t Unsigned(std::string_view bytes, std::size_t at, std::size_t count,
                              bool big_endian) {
  if (at > bytes.size() || bytes.size() - at < count) return 0;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = big_endian ? at + i : at + count - 1 - i;
    value = (value << 8) | static_cast<unsigned char>(bytes[from]);
  }
  return value;
}

}  // namespace telestrain
