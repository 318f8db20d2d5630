#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace telestrain {

// Whether `text` is well-formed UTF-8 (RFC 3629): no stray or missing continuation byte, no code
// point written longer than needed, no surrogate, none above U+10FFFF. Zero bytes are well-formed.
// Texts of input files end up in JSON results, which hold nothing else.
bool IsValidUtf8(std::string_view text);

// `text` as it may go to a terminal or into one line: bytes of control characters, of line and
// paragraph separators, of marks that turn the writing direction, and bytes that are not UTF-8 are
// written as \xNN. For names and paths that come out of files.
std::string PrintableText(std::string_view text);

// The first characters of `text`, at most `most_bytes` bytes of them: a cut through a character
// would leave bytes that are not UTF-8.
std::string_view FirstCharacters(std::string_view text, std::size_t most_bytes);

}  // namespace telestrain
