#pragma once

#include <string_view>

namespace telestrain {

// Whether `text` is well-formed UTF-8 (RFC 3629): no stray or missing continuation byte, no code
// point written longer than needed, no surrogate, none above U+10FFFF. Zero bytes are well-formed.
// Texts of input files end up in JSON results, which hold nothing else.
bool IsValidUtf8(std::string_view text);

}  // namespace telestrain
