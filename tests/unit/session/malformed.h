#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace telestrain {

// One change to the sample folder and what the reader must say about it.
struct Malformed {
  std::string name;
  std::string file;
  std::string from, to;           // replaced in the file
  std::string line_of;            // text that stands in the line that the error must name
  std::vector<std::string> says;  // what was found, the limit and the remedy
};

void PrintTo(const Malformed& malformed, std::ostream* out);

// Makes the change and expects an error (kBadInput) at that line with those words.
void ExpectRefused(const Malformed& malformed);

}  // namespace telestrain
