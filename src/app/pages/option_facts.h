#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace telestrain {

// What the user of an option has to know, read from the table that parses it: help, man pages,
// completion and the pages of the verbs cannot tell of another option than the program takes.
struct OptionFacts {
  std::vector<std::string> names;  // "--out", or "-h" and "--help"; of an argument its one name
  bool is_argument = false;        // stands without a name
  bool is_required = false;
  int least_values = 0, most_values = 0;  // 0: a switch; kManyValues: any number
  std::string value;                      // what stands for a value, as FILE, FOLDER, PX, N
  std::vector<std::string> choices;       // the values that there are; empty: not a fixed list
  char delimiter = '\0';                  // between values in one word
  std::string range;                      // "0 to 2" or empty
  std::string default_value;
  std::string environment;  // variable that gives the value too
  std::vector<std::string> needs, excludes;
  std::string help;

  static constexpr int kManyValues = 1000;
  // "--out FOLDER", "--backend osmesa|egl", "-h, --help".
  std::string Shown() const;
};

// In the order of the table, --help last; of an app with verbs, those of the app alone.
std::vector<OptionFacts> OptionsOf(const CLI::App& app);

}  // namespace telestrain
