#include "viz/desk/desk_arguments.h"

#include <CLI/CLI.hpp>

#include "base/value_names.h"
#include "viz/scene/part.h"

namespace telestrain {
namespace {

constexpr const char* kFooter =
    "Keys: 1 array, 2 side, 3 top, 4 pipe; left and right: states; up and down: quantities; C: "
    "colours\nof all states or of one; V O B R P M D G U F: layers; S saves the window as PNG in "
    "the working folder; H lists all; Q "
    "quits.\n"
    "Exit codes: 0 done, 2 wrong usage, 3 bad results, 5 no display or a file that cannot be "
    "written,\n70 a defect of the program.\n"
    "Example: telestrain-view results --state 3 --quantity hoop_microstrain";

}  // namespace

void DeskArguments::AddTo(CLI::App& app) {
  app.name("telestrain-view");
  app.description(
      "telestrain-view shows the results of telestrain on the desktop: the views, the boards, the\n"
      "rulers and the strained pipe, to turn, to measure and to point at.");
  app.set_version_flag("--version", "telestrain-view " TELESTRAIN_VERSION);
  app.footer(kFooter);
  app.add_option("RESULTS", results, "results folder of telestrain")
      ->type_name(kFolder)
      ->required();
  app.add_option("--view", view, "1 array, 2 side, 3 top, 4 pipe")
      ->type_name(kCount)
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  app.add_option("--state", state, "state of the pipe: its number from 0, its image or 'largest'")
      ->type_name("STATE")
      ->capture_default_str();
  app.add_option("--quantity", quantity,
                 "what colours the pipe: a point array of pipe_NNN.vtp (default: axial strain)")
      ->type_name("QUANTITY");
  std::vector<std::string> names;
  for (const viz::Layer layer : viz::kAllLayers) names.push_back(NameOf(layer));
  app.add_option("--layers", layers, "what is visible at first, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--size", size, "WIDTHxHEIGHT of the window in px")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  app.add_option("--screenshot", screenshot,
                 "draw the window once, save it as this PNG file and leave")
      ->type_name(kFile);
}

}  // namespace telestrain
