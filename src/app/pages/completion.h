#pragma once

#include <string>

namespace CLI {
class App;
}

namespace telestrain {

// Completion of a program's command line for three shells: verbs, options, the values of options
// that have a fixed list, and files or folders where an option or argument takes one. Made from the
// table of options, so nothing is offered that the program refuses by name.

// Source for bash 4 or newer; needs no other package.
std::string BashCompletion(const CLI::App& program);
// The function file of zsh: _telestrain.
std::string ZshCompletion(const CLI::App& program);
// Commands for fish 3.
std::string FishCompletion(const CLI::App& program);

}  // namespace telestrain
