#pragma once

#include <string>

namespace telestrain {

// A library as this program knows it: the version of its headers when the program was compiled, and
// the version that is loaded now, where the library can say it (else empty).
struct LibraryVersion {
  std::string name, compiled, loaded;
};

}  // namespace telestrain
