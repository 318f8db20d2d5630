#pragma once

#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

namespace telestrain::testing_support {

// The values of "--name N" on the command line over their defaults; prints `help` for --help and
// ends, and ends with 2 for anything else.
inline std::map<std::string, long> NumbersOf(int argc, char** argv,
                                             std::map<std::string, long> numbers,
                                             const std::string& help) {
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--help") {
      std::cout << help;
      std::exit(0);
    }
    if (!name.starts_with("--") || !numbers.contains(name.substr(2)) || i + 1 == argc) {
      std::cerr << "no such option, or no number after it: " << name << "; see --help\n";
      std::exit(2);
    }
    numbers[name.substr(2)] = std::atol(argv[i + 1]);
  }
  return numbers;
}

}  // namespace telestrain::testing_support
