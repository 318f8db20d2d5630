#include "report/unicode_text.h"

namespace telestrain {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

struct Lead {
  int length;  // bytes of the sequence, 0 for an ill-formed lead
  char32_t bits;
  char32_t least;  // smaller values are overlong
};

Lead DecodeLead(unsigned char byte) {
  if (byte < 0x80) return {1, byte, 0};
  if (byte >= 0xC2 && byte < 0xE0) return {2, byte & 0x1Fu, 0x80};
  if (byte >= 0xE0 && byte < 0xF0) return {3, byte & 0x0Fu, 0x800};
  if (byte >= 0xF0 && byte < 0xF5) return {4, byte & 0x07u, 0x10000};
  return {0, 0, 0};
}

bool IsValid(char32_t code_point, const Lead& lead) {
  const bool surrogate = code_point >= 0xD800 && code_point <= 0xDFFF;
  return code_point >= lead.least && code_point <= 0x10FFFF && !surrogate;
}

}  // namespace

std::vector<char32_t> CodePoints(std::string_view utf8) {
  std::vector<char32_t> points;
  points.reserve(utf8.size());
  for (std::size_t i = 0; i < utf8.size();) {
    const Lead lead = DecodeLead(static_cast<unsigned char>(utf8[i]));
    char32_t point = lead.bits;
    int read = 1;
    for (; read < lead.length && i + read < utf8.size(); ++read) {
      const auto byte = static_cast<unsigned char>(utf8[i + read]);
      if ((byte & 0xC0) != 0x80) break;
      point = (point << 6) | (byte & 0x3Fu);
    }
    const bool complete = lead.length > 0 && read == lead.length && IsValid(point, lead);
    points.push_back(complete ? point : kReplacement);
    i += complete ? static_cast<std::size_t>(lead.length) : 1;
  }
  return points;
}

std::string Utf8(char32_t code_point) {
  const auto tail = [code_point](int shift) {
    return static_cast<char>(0x80 | ((code_point >> shift) & 0x3F));
  };
  if (code_point < 0x80) return {static_cast<char>(code_point)};
  if (code_point < 0x800) return {static_cast<char>(0xC0 | (code_point >> 6)), tail(0)};
  if (code_point < 0x10000) return {static_cast<char>(0xE0 | (code_point >> 12)), tail(6), tail(0)};
  return {static_cast<char>(0xF0 | (code_point >> 18)), tail(12), tail(6), tail(0)};
}

std::string CodePointName(char32_t code_point) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  std::string digits;
  for (int shift = 20; shift >= 0; shift -= 4)
    if (!digits.empty() || (code_point >> shift) != 0 || shift < 16)
      digits.push_back(kDigits[(code_point >> shift) & 15]);
  return "U+" + digits;
}

bool BreaksAnywhere(char32_t c) {
  return (c >= 0x2E80 && c <= 0x9FFF) || (c >= 0xAC00 && c <= 0xD7AF) ||
         (c >= 0xF900 && c <= 0xFAFF) || (c >= 0xFF00 && c <= 0xFFEF);
}

bool MayNotBeginLine(char32_t c) {
  static constexpr std::u32string_view kClosing =
      U"!%),.:;?]}°’”…‰′″℃、。々〉》」』】〕〗〞ー·！％），．：；？］｝～￠";
  return kClosing.find(c) != std::u32string_view::npos;
}

bool MayNotEndLine(char32_t c) {
  static constexpr std::u32string_view kOpening = U"([{‘“〈《「『【〔〖〝（［｛￡￥";
  return kOpening.find(c) != std::u32string_view::npos;
}

}  // namespace telestrain
