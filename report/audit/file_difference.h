#pragma once

#include <string>

namespace telestrain {

// Where a file that was found first differs from the one that was made again, in words: of JSON the
// pointer and both values (`/verdict is "pass", made again "fail"`), of text the line, else the
// byte. Empty when they are equal.
std::string FirstDifference(const std::string& name, const std::string& found,
                            const std::string& again);

}  // namespace telestrain
