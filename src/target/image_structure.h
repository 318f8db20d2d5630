#pragma once

#include <string>
#include <string_view>

namespace telestrain {

// Why an image file cannot be what it says, by its structure alone and without decoding: it breaks
// off, it is too short for the size that it states (the memory that a decoder takes would follow
// from a lie), it holds several images, or its compression is none that is read. In words that
// follow "the image "; empty when nothing is found. For formats of SizeFromHeader with a size above
// zero. Time grows with the file's length, memory does not.
std::string StructureFault(std::string_view bytes);

}  // namespace telestrain
