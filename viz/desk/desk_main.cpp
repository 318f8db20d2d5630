#include <vtkRenderWindowInteractor.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "base/files.h"
#include "viz/desk/desk_control.h"
#include "viz/desk/desk_style.h"
#include "viz/png_bytes.h"
#include "viz/scene_from_results.h"

// telestrain-view RESULTS
//   a window with the scene; H lists the keys

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr int kUsageExit = 2, kDefectExit = 70;

constexpr const char* kFooter =
    "Keys: 1 array, 2 side, 3 top, 4 pipe; left and right: states; up and down: quantities; V O B "
    "R P\nM D G U F: layers; S saves the window as PNG in the working folder; H lists all; Q "
    "quits.\n"
    "Exit codes: 0 done, 2 wrong usage, 3 bad results, 5 no display or a file that cannot be "
    "written,\n70 a defect of the program.\n"
    "Example: telestrain-view results --state 3 --quantity hoop_microstrain";

struct Arguments {
  std::string results, quantity, screenshot;
  std::optional<int> state;
  int view = 1, width_px = 1440, height_px = 900;
  std::vector<std::string> layers;

  void AddTo(CLI::App& app);
};

void Arguments::AddTo(CLI::App& app) {
  app.add_option("RESULTS", results, "results folder of telestrain")->required();
  app.add_option("--view", view, "1 array, 2 side, 3 top, 4 pipe")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  app.add_option("--state", state,
                 "pipe state: the number in pipe_NNN.vtp (default: the one with the largest "
                 "strain)");
  app.add_option("--quantity", quantity,
                 "what colours the surface: a name in pipe_NNN.vtp (default: axial_microstrain)");
  std::vector<std::string> names;
  for (const viz::Layer layer : viz::kAllLayers) names.push_back(NameOf(layer));
  app.add_option("--layers", layers, "what is visible at first, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--width-px", width_px, "of the window")
      ->check(CLI::Range(640, 8192))
      ->capture_default_str();
  app.add_option("--height-px", height_px, "of the window")
      ->check(CLI::Range(480, 8192))
      ->capture_default_str();
  app.add_option("--screenshot", screenshot,
                 "draw the window once, save it as this PNG file and leave");
}

Result<viz::DeskModel> ModelOf(const Arguments& arguments) {
  const fs::path results = arguments.results;
  TELESTRAIN_ASSIGN_OR_RETURN(viz::Scene scene, viz::SceneFromResults(results));
  TELESTRAIN_ASSIGN_OR_RETURN(auto shown,
                              viz::ChooseValues(scene, arguments.state, arguments.quantity));
  const fs::path whole = fs::absolute(results).lexically_normal();
  const fs::path folder = whole.has_filename() ? whole : whole.parent_path();
  const fs::path title = folder.parent_path().filename() / folder.filename();
  viz::DeskModel model(title.string(), std::move(scene), std::move(shown));
  model.ArrangeFor(static_cast<viz::StandardView>(arguments.view));
  std::set<viz::Layer> layers;
  for (const viz::Layer layer : viz::kAllLayers)
    for (const std::string& name : arguments.layers)
      if (NameOf(layer) == name) layers.insert(layer);
  if (!layers.empty()) model.ShowOnly(layers);
  return model;
}

Status Screenshot(viz::DeskWindow* window, const std::string& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const viz::RgbImage image, window->Grab());
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string png, viz::PngBytes(image));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(path, png));
  std::cout << "wrote " << path << '\n';
  return {};
}

Status View(const Arguments& arguments) {
  TELESTRAIN_ASSIGN_OR_RETURN(viz::DeskModel model, ModelOf(arguments));
  TELESTRAIN_ASSIGN_OR_RETURN(
      const auto window, viz::DeskWindow::Open(&model, arguments.width_px, arguments.height_px));
  window->LookFrom(static_cast<viz::StandardView>(arguments.view));
  if (!arguments.screenshot.empty()) return Screenshot(window.get(), arguments.screenshot);
  viz::DeskControl control(&model, window.get(), fs::current_path());
  const auto interactor = viz::MakeInteractor(window.get(), &control);
  window->Render();
  interactor->Start();
  return {};
}

int Main(int argc, char** argv) {
  CLI::App app{
      "telestrain-view shows the results of telestrain on the desktop: the views, the boards, the\n"
      "rulers and the strained pipe, to turn, to measure and to point at."};
  app.name("telestrain-view");
  app.set_version_flag("--version", "telestrain-view " TELESTRAIN_VERSION);
  app.footer(kFooter);
  Arguments arguments;
  arguments.AddTo(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : kUsageExit;
  }
  const Status status = View(arguments);
  if (status) return 0;
  std::cerr << "telestrain-view: " << status.error().message << '\n';
  return static_cast<int>(status.error().kind);
}

}  // namespace
}  // namespace telestrain

int main(int argc, char** argv) {
  try {
    return telestrain::Main(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << "telestrain-view: a defect of the program: " << e.what()
              << "\nPlease report it with the command line and the results.\n";
    return telestrain::kDefectExit;
  }
}
