#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>

namespace telestrain::viz {

// Adds a number to the end of a file's bytes, least significant byte first on every machine.
template <std::unsigned_integral Number>
void AppendLittleEndian(Number number, std::string* bytes) {
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    bytes->push_back(static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i) & 255));
}
inline void AppendLittleEndian(float number, std::string* bytes) {
  AppendLittleEndian(std::bit_cast<std::uint32_t>(number), bytes);
}
inline void AppendLittleEndian(double number, std::string* bytes) {
  AppendLittleEndian(std::bit_cast<std::uint64_t>(number), bytes);
}

}  // namespace telestrain::viz
