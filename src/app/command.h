#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/console.h"
#include "base/result.h"

namespace CLI {
class App;
}

namespace telestrain {

// One verb of the program: its options, and what it does once they are read.
class Command {
 public:
  virtual ~Command() = default;
  virtual std::string Name() const = 0;
  virtual std::string Summary() const = 0;  // one line, shown in the list of verbs
  virtual std::string Example() const = 0;  // shown at the end of the verb's help
  virtual void AddOptions(CLI::App& app) = 0;
  // The exit code: 0, or 1 when something was measured and lies outside its limits.
  virtual Result<int> Run(Console& console) = 0;
};

std::unique_ptr<Command> MakeSimulateCommand();
std::unique_ptr<Command> MakeDesignCommand();
std::unique_ptr<Command> MakeCorrelateCommand();
std::unique_ptr<Command> MakeDetectCommand();
std::unique_ptr<Command> MakeCalibrateCommand();
std::unique_ptr<Command> MakeDiagnoseCommand();
std::unique_ptr<Command> MakeVerifyCommand();
std::unique_ptr<Command> MakeMeasureCommand();
std::unique_ptr<Command> MakeRenderCommand();
std::unique_ptr<Command> MakeReportCommand();
std::unique_ptr<Command> MakeReviewCommand();
std::unique_ptr<Command> MakeExportCommand();
std::unique_ptr<Command> MakeSignCommand();
std::unique_ptr<Command> MakeStudyCommand();
std::unique_ptr<Command> MakeRunCommand();
std::unique_ptr<Command> MakeAuditCommand();

// The two folders that most verbs take.
struct SessionArguments {
  std::string session, out;
  void AddTo(CLI::App& app);
};
// --corners FILE: where the corners of the target come from instead of the calibration images.
void AddCornersOption(CLI::App& app, std::string& corners);
// How to calibrate.
struct CalibrateArguments {
  std::string compare;
  std::string outliers = "median";  // or "mrcal", "weigh"
  bool board_warp = false;
  std::vector<std::string> culled;  // "X,Y,WIDTH,HEIGHT"
  void AddTo(CLI::App& app);
};

// How to measure the pipe.
struct MeasureArguments {
  int subset_px = 0, step_px = 0;
  std::string watch;
  int until = 0;
  double idle_s = 0;
  void AddTo(CLI::App& app);  // subset and step
  void AddWatchTo(CLI::App& app);
};

}  // namespace telestrain
