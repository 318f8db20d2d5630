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

// The bytes of the well-formed sequence at the beginning of `text`, which is not empty; 0 when
// there is none.
std::size_t LengthOfFirst(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const Sequence sequence = SequenceOf(byte(0));
  if (sequence.length > text.size()) return 0;
  for (std::size_t i = 1; i < sequence.length; ++i) {
    const unsigned char low = i == 1 ? sequence.second_min : 0x80;
    const unsigned char high = i == 1 ? sequence.second_max : 0xBF;
    if (byte(i) < low || byte(i) > high) return 0;
  }
  return sequence.length;
}

// Of one well-formed character: C0, DEL and C1 controls; U+200E, U+200F, U+2028 to U+202E and
// U+2066 to U+2069.
bool MovesText(std::string_view character) {
  const auto byte = [character](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 1) return byte(0) < 0x20 || byte(0) == 0x7F;
  if (character.size() == 2) return byte(0) == 0xC2 && byte(1) < 0xA0;
  if (character.size() != 3 || byte(0) != 0xE2) return false;
  const unsigned char last = byte(2);
  if (byte(1) == 0x80) return last == 0x8E || last == 0x8F || (last >= 0xA8 && last <= 0xAE);
  return byte(1) == 0x81 && last >= 0xA6 && last <= 0xA9;
}

}  // namespace

bool IsValidUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = LengthOfFirst(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string PrintableText(std::string_view text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string printable;
  while (!text.empty()) {
    const std::size_t length = LengthOfFirst(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    if (length != 0 && !MovesText(character)) {
      printable += character;
    } else {
      for (const char c : character) {
        const auto byte = static_cast<unsigned char>(c);
        printable += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
      }
    }
    text.remove_prefix(character.size());
  }
  return printable;
}

std::string_view FirstCharacters(std::string_view text, std::size_t most_bytes) {
  if (text.size() <= most_bytes) return text;
  std::size_t end = most_bytes;  // continuation bytes are 10xxxxxx
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end);
}

}  // namespace telestrain
