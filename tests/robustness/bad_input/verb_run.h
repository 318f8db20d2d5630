#pragma once

#include <string>
#include <vector>

namespace telestrain::testing_support {

// What a verb did that ran in this process.
struct VerbRun {
  int exit_code = 0;
  std::string err;  // the last line says why
};
// As the program does, with its console; what throws is a defect (70).
VerbRun RunVerb(const std::vector<std::string>& words);

}  // namespace telestrain::testing_support
