#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/steps.h"

// telestrain report RESULTS
//   report     /data/results/report.pdf
//   verdict    pass

namespace telestrain {
namespace {

class ReportCommand : public Command {
 public:
  std::string Name() const override { return "report"; }
  std::string Summary() const override {
    return "decide the limits and write results.json and the PDF acceptance report";
  }
  std::string Example() const override { return "telestrain report results"; }
  void AddOptions(CLI::App& app) override {
    app.add_option("RESULTS", results_, "results folder of the earlier steps")->required();
    app.add_option("--templates", templates_,
                   "folder with your own acceptance.json (layout and texts of the report)");
  }
  Result<int> Run(Console& console) override { return ReportStep(results_, templates_, console); }

 private:
  std::string results_, templates_;
};

}  // namespace

std::unique_ptr<Command> MakeReportCommand() { return std::make_unique<ReportCommand>(); }

}  // namespace telestrain
