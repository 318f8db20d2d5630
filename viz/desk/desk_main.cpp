#include <vtkRenderWindowInteractor.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <exception>
#include <iostream>

#include "base/files.h"
#include "base/numbers.h"
#include "session/made_from.h"
#include "viz/desk/desk_arguments.h"
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

// "1440x900".
Result<std::array<int, 2>> SizeOf(const std::string& text) {
  constexpr int kLeast_px = 480, kMost_px = 8192;  // below, the panel has no room
  const auto x = text.find('x');
  const auto width = x == std::string::npos ? std::nullopt : ParseInt(text.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : ParseInt(text.substr(x + 1));
  if (width && height && std::min(*width, *height) >= kLeast_px &&
      std::max(*width, *height) <= kMost_px)
    return std::array{*width, *height};
  return Error{ErrorKind::kUsage,
               "--size takes WIDTHxHEIGHT in px from 480x480 to 8192x8192, as "
               "in 1440x900, found '" +
                   text + "'"};
}

Result<viz::DeskModel> ModelOf(const DeskArguments& arguments) {
  const fs::path results = arguments.results;
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kRender));
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

Status View(const DeskArguments& arguments) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto size_px, SizeOf(arguments.size));
  TELESTRAIN_ASSIGN_OR_RETURN(viz::DeskModel model, ModelOf(arguments));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto window,
                              viz::DeskWindow::Open(&model, size_px[0], size_px[1]));
  window->LookFrom(static_cast<viz::StandardView>(arguments.view));
  if (!arguments.screenshot.empty()) return Screenshot(window.get(), arguments.screenshot);
  viz::DeskControl control(&model, window.get(), fs::current_path());
  const auto interactor = viz::MakeInteractor(window.get(), &control);
  window->Render();
  interactor->Start();
  return {};
}

int Main(int argc, char** argv) {
  CLI::App app;
  DeskArguments arguments;
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
