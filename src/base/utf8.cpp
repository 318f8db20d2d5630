#include "base/utf8.h"

#include <cstddef>

namespace telestrain {
namespace {

// The length of the sequence that `lead` begins, and where its second byte may lie; this range
// alone keeps out overlong forms, surrogates and what is above U+10FFFF.
struct Sequence {
  std::size_t length = 0;  // 0: no sequence begins like this
  unsigned char second_min = 0x80, second_max = 0xBF;
};

Sequence SequenceOf(unsigned char lead) {
  if (lead < 0x80) return {1};
  if (lead < 0xC2) return {0};
  if (lead < 0xE0) return {2};
  if (lead == 0xE0) return {3, 0xA0};
  if (lead == 0xED) return {3, 0x80, 0x9F};
  if (lead < 0xF0) return {3};
  if (lead == 0xF0) return {4, 0x90};
  if (lead < 0xF4) return {4};
  if (lead == 0xF4) return {4, 0x80, 0x8F};
  return {0};
}

}  // namespace

bool IsValidUtf8(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  for (std::size_t begin = 0; begin < text.size();) {
    const Sequence sequence = SequenceOf(byte(begin));
    if (sequence.length == 0 || sequence.length > text.size() - begin) return false;
    for (std::size_t i = 1; i < sequence.length; ++i) {
      const unsigned char low = i == 1 ? sequence.second_min : 0x80;
      const unsigned char high = i == 1 ? sequence.second_max : 0xBF;
      if (byte(begin + i) < low || byte(begin + i) > high) return false;
    }
    begin += sequence.length;
  }
  return true;
}

}  // namespace telestrain
