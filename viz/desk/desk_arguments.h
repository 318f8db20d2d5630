#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace telestrain {

// The words of telestrain-view.
struct DeskArguments {
  std::string results, quantity, screenshot, state = "largest", size = "1440x900";
  int view = 1;
  std::vector<std::string> layers;

  // Name, description and footer of the program and its options.
  void AddTo(CLI::App& app);
};

}  // namespace telestrain
