#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace telestrain {

// The code points of UTF-8 text; an ill-formed byte becomes U+FFFD.
std::vector<char32_t> CodePoints(std::string_view utf8);
// One code point as UTF-8.
std::string Utf8(char32_t code_point);
// "U+1F600".
std::string CodePointName(char32_t code_point);
// Scripts written without spaces, where a line may break after every character.
bool BreaksAnywhere(char32_t code_point);
// But not before closing punctuation, nor behind opening punctuation (of Chinese and of European
// texts that stand in Chinese ones).
bool MayNotBeginLine(char32_t code_point);
bool MayNotEndLine(char32_t code_point);

}  // namespace telestrain
