#pragma once

#include <string>

namespace telestrain {

// Why a PDF is not built as ours are, to be asked before a library reads it; empty when it is.
// Ours have plain cross-reference tables only, each naming the one before it by /Prev.
// Cross-reference streams are refused, and with them object streams, which nothing else can name:
// both may unpack to any size before anything can be checked. So is what a library would have to
// guess: a file that does not end with "startxref NUMBER %%EOF".
std::string WhyNotClassicPdf(const std::string& bytes);

}  // namespace telestrain
