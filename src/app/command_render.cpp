#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/render_arguments.h"
#include "app/results_folder.h"
#include "app/step_options.h"
#include "app/step_record.h"
#include "app/steps.h"
#include "base/value_names.h"

// telestrain render RESULTS
//   render     pictures in results/pictures

namespace telestrain {
namespace {

class RenderCommand : public Command {
 public:
  std::string Name() const override { return "render"; }
  std::string Summary() const override {
    return "draw the array, the target poses and the strained pipe, without a screen";
  }
  std::string Example() const override {
    return "telestrain render results\n"
           "         telestrain render results --view pipe_strain --state 3 --range 0 500 --out "
           "a.png";
  }
  void AddOptions(CLI::App& app) override {
    app.add_option("RESULTS", results_, "results folder of the earlier steps")
        ->type_name(kFolder)
        ->required();
    arguments_.AddTo(app);
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_ASSIGN_OR_RETURN(const RenderOptions options, ReadOptions(arguments_));
    TELESTRAIN_ASSIGN_OR_RETURN(const ResultsLock lock, ResultsLock::Take(results_));
    TELESTRAIN_RETURN_IF_ERROR(arguments_.Film().empty()
                                   ? RenderStep(results_, options, arguments_.out, console)
                                   : Film(options, console));
    return 0;
  }

 private:
  Status Film(const RenderOptions& options, Console& console) const {
    TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results_, Step::kRender));
    const bool turns = !arguments_.turntable.empty();
    TELESTRAIN_RETURN_IF_ERROR(
        turns ? RenderTurntable(results_, options, arguments_.video, arguments_.turntable, console)
              : RenderStates(results_, options, arguments_.video, arguments_.states, console));
    const std::filesystem::path film = arguments_.Film();
    StepRecord record = SceneRecord("render", results_);
    record.options = OptionsJson(options);
    for (const char* not_of_films : {"view", "reported", "state", "transparent"})
      record.options.erase(not_of_films);
    record.options["seconds"] = arguments_.video.seconds;
    record.options["fps"] = arguments_.video.frames_per_second;
    record.options[turns ? "turntable" : "states"] = RecordedPlace(results_, film);
    record.outputs = {film.filename().string()};
    record.outputs_folder = film.has_parent_path() ? film.parent_path() : ".";
    return RecordStep(results_, record);
  }

  std::string results_;
  RenderArguments arguments_;
};

}  // namespace

std::unique_ptr<Command> MakeRenderCommand() { return std::make_unique<RenderCommand>(); }

}  // namespace telestrain
