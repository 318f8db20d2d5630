#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace telestrain {

// The distinguished encoding of ASN.1 (X.690), as far as signatures need it: one-byte tags,
// definite lengths of up to three bytes.

inline constexpr unsigned char kDerInteger = 0x02, kDerOctets = 0x04, kDerNull = 0x05,
                               kDerOid = 0x06, kDerSequence = 0x30, kDerSet = 0x31;
inline constexpr unsigned char kDerContext0 = 0xA0, kDerContext1 = 0xA1;

struct DerNode {
  unsigned char tag = 0;
  std::string_view whole;    // with tag and length
  std::string_view content;  // without
};

// A value with tag and shortest length.
std::string Der(unsigned char tag, std::string_view content);
// The SET OF these encodings, in the order DER wants.
std::string DerSetOf(unsigned char tag, std::vector<std::string> members);

// The one node that `bytes` is; nothing when it is not exactly one.
std::optional<DerNode> ReadDer(std::string_view bytes);
// The nodes that follow one another in `content`; nothing when it does not end with one.
std::optional<std::vector<DerNode>> DerChildren(std::string_view content);

// The length of the node that `bytes` begins with, 0 when none does or it is longer than `bytes`.
std::size_t DerLength(std::string_view bytes);

}  // namespace telestrain
