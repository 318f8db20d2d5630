#include "robustness/bad_input/verb_run.h"

#include <CLI/CLI.hpp>
#include <sstream>

#include "app/program.h"

namespace telestrain::testing_support {

VerbRun RunVerb(const std::vector<std::string>& words) {
  std::vector<const char*> arguments{"telestrain"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  std::ostringstream out, err;
  Console console(out, err, false);
  try {
    Program program;
    program.app().parse(static_cast<int>(arguments.size()), arguments.data());
    const Result<int> result = program.Chosen()->Run(console);
    if (result) return {*result, err.str()};
    return {static_cast<int>(result.error().kind), err.str() + result.error().message};
  } catch (const CLI::ParseError& e) {
    return {2, e.what()};
  } catch (const std::exception& e) {
    return {70, e.what()};
  }
}

}  // namespace telestrain::testing_support
