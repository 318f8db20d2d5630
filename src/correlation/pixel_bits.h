#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "session/session.h"

namespace telestrain::correlation {

// One bit for every pixel of a region. Empty where no bit is set.
class PixelBits {
 public:
  PixelBits() = default;
  PixelBits(int width, int height)
      : words_per_row_(width / 64 + 2),  // one more than needed, for reading across words
        words_(static_cast<std::size_t>(words_per_row_) * height) {}

  bool empty() const { return words_.empty(); }
  std::ptrdiff_t words_per_row() const { return words_per_row_; }
  const std::uint64_t* Row(int y) const { return words_.data() + y * words_per_row_; }
  std::uint64_t* Row(int y) { return words_.data() + y * words_per_row_; }
  bool At(int x, int y) const { return Row(y)[x / 64] >> (x % 64) & 1; }

  // Set bits in a rectangle that lies in the region.
  std::int64_t Count(const PixelRegion& part) const {
    if (empty()) return 0;
    const int first = part.x / 64, last = (part.x + part.width - 1) / 64;
    const std::uint64_t from = ~std::uint64_t{0} << (part.x % 64);
    const std::uint64_t to = ~std::uint64_t{0} >> (63 - (part.x + part.width - 1) % 64);
    std::int64_t count = 0;
    for (int y = part.y; y < part.y + part.height; ++y) {
      const std::uint64_t* row = Row(y);
      for (int word = first; word <= last; ++word) {
        const std::uint64_t kept =
            (word == first ? from : ~std::uint64_t{0}) & (word == last ? to : ~std::uint64_t{0});
        count += std::popcount(row[word] & kept);
      }
    }
    return count;
  }

 private:
  std::ptrdiff_t words_per_row_ = 0;
  std::vector<std::uint64_t> words_;
};

// Eight bytes of zero or one as eight bits: the product brings byte k to bit 56 + k.
inline std::uint64_t PackedBytes(const unsigned char* bytes) {
  std::uint64_t eight = 0;
  for (int k = 0; k < 8; ++k) eight |= static_cast<std::uint64_t>(bytes[k]) << (8 * k);
  return (eight * 0x0102040810204080u) >> 56;
}

// The pixels of a region for which `is_set(x, y)`, with the coordinates of the whole image. A row's
// answers are first collected as bytes, which compilers turn into vectors, and then packed.
template <class IsSet>
PixelBits BitsWhere(const PixelRegion& region, const IsSet& is_set) {
  PixelBits bits(region.width, region.height);
  std::uint64_t any = 0;
  std::vector<unsigned char> flags((static_cast<std::size_t>(region.width) + 63) / 64 * 64);
  for (int y = 0; y < region.height; ++y) {
    for (int x = 0; x < region.width; ++x) flags[x] = is_set(region.x + x, region.y + y);
    std::uint64_t* row = bits.Row(y);
    for (int x = 0; x < region.width; x += 64) {
      std::uint64_t word = 0;
      for (int k = 0; k < 64; k += 8) word |= PackedBytes(&flags[x + k]) << k;
      row[x / 64] = word;
      any |= word;
    }
  }
  return any ? bits : PixelBits();
}

}  // namespace telestrain::correlation
