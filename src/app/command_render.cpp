#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/render_arguments.h"
#include "app/results_folder.h"
#include "app/steps.h"

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
    app.add_option("RESULTS", results_, "results folder of the earlier steps")->required();
    arguments_.AddTo(app);
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_ASSIGN_OR_RETURN(const RenderOptions options, ReadOptions(arguments_));
    TELESTRAIN_RETURN_IF_ERROR(arguments_.Film().empty()
                                   ? RenderStep(results_, options, arguments_.out, console)
                                   : Film(options, console));
    return 0;
  }

 private:
  Status Film(const RenderOptions& options, Console& console) const {
    TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results_, Step::kRender));
    if (!arguments_.turntable.empty())
      return RenderTurntable(results_, options, arguments_.video, arguments_.turntable, console);
    return RenderStates(results_, options, arguments_.video, arguments_.states, console);
  }

  std::string results_;
  RenderArguments arguments_;
};

}  // namespace

std::unique_ptr<Command> MakeRenderCommand() { return std::make_unique<RenderCommand>(); }

}  // namespace telestrain
