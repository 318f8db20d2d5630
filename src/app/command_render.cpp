#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/render_arguments.h"
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
    TELESTRAIN_RETURN_IF_ERROR(RenderStep(results_, options, arguments_.out, console));
    return 0;
  }

 private:
  std::string results_;
  RenderArguments arguments_;
};

}  // namespace

std::unique_ptr<Command> MakeRenderCommand() { return std::make_unique<RenderCommand>(); }

}  // namespace telestrain
