#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/steps.h"
#include "base/value_names.h"

// telestrain diagnose RESULTS
//   diagnose   The residuals are noise. mrcal agrees to 5.0e-10 px.
//     residuals, RMS of a coordinate       0.0048 px    expected 0.0048 px
//     mrcal's optimum, undistorted model   2.0e-10 px   at most 1.0e-06 px   agrees
//     …

namespace telestrain {
namespace {

class DiagnoseCommand : public Command {
 public:
  std::string Name() const override { return "diagnose"; }
  std::string Summary() const override {
    return "check the calibration: mrcal's optimum, residuals, pinhole cameras";
  }
  std::string Example() const override { return "telestrain diagnose results"; }
  void AddOptions(CLI::App& app) override {
    app.add_option("RESULTS", results_, "results folder with a calibration")
        ->type_name(kFolder)
        ->required();
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_ASSIGN_OR_RETURN(const ResultsLock lock, ResultsLock::Take(results_));
    return DiagnoseStep(results_, true, console);
  }

 private:
  std::string results_;
};

}  // namespace

std::unique_ptr<Command> MakeDiagnoseCommand() { return std::make_unique<DiagnoseCommand>(); }

}  // namespace telestrain
