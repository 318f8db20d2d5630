#include "app/command.h"
#include "app/steps.h"

// clang-format off
// telestrain run SESSION --out RESULTS
//   detect     93 of 96 board views used, 48 of 48 ruler crosses
//   calibrate  magnification 227.3823 px/mm, lens model k1 p1 p2, reprojection RMS 0.0022 px over 10881 corners
//   diagnose   The residuals are noise. mrcal agrees to 9.6e-08 px.
//   verify     12 ruler lengths, error mean 0.002 um, sd 0.008 um, largest 0.020 um
//   measure    6 states, 475 surface points, pipe diameter 8.0004 mm
//   render     pictures in results/pictures
//   report     /data/results/report.pdf
//   verdict    pass
// A run that was ended goes on where it was; what is finished already says so:
//   detect     kept: made from the same inputs, options and program
// clang-format on

namespace telestrain {
namespace {

class RunCommand : public Command {
 public:
  std::string Name() const override { return "run"; }
  std::string Summary() const override {
    return "do everything: detect, calibrate, diagnose, verify, measure, render, report";
  }
  std::string Example() const override { return "telestrain run session --out results"; }
  void AddOptions(CLI::App& app) override {
    arguments_.AddTo(app);
    AddCornersOption(app, corners_);
    choices_.AddTo(app);
    measure_.AddTo(app);
  }
  Result<int> Run(Console& console) override {
    const std::string& out = arguments_.out;
    TELESTRAIN_ASSIGN_OR_RETURN(const CalibrateChoices choices, ReadChoices(choices_));
    TELESTRAIN_ASSIGN_OR_RETURN(const MeasureChoices measure, ReadChoices(measure_));
    TELESTRAIN_ASSIGN_OR_RETURN(ResultsLock lock, ResultsLock::Take(out));
    constexpr Earlier kEarlier = Earlier::kKept;
    TELESTRAIN_ASSIGN_OR_RETURN(const Session session,
                                OpenSession(arguments_.session, out, corners_, lock, kEarlier));
    TELESTRAIN_RETURN_IF_ERROR(DetectStep(session, out, corners_, console, kEarlier));
    TELESTRAIN_RETURN_IF_ERROR(CalibrateStep(session, out, choices, console, kEarlier));
    TELESTRAIN_RETURN_IF_ERROR(DiagnoseStep(out, console, kEarlier));
    TELESTRAIN_RETURN_IF_ERROR(VerifyStep(session, out, console, kEarlier));
    TELESTRAIN_RETURN_IF_ERROR(MeasureStep(session, out, measure, console, kEarlier));
    TELESTRAIN_RETURN_IF_ERROR(RenderStep(out, console, kEarlier));
    return ReportStep(out, {}, console, kEarlier);
  }

 private:
  SessionArguments arguments_;
  std::string corners_;
  CalibrateArguments choices_;
  MeasureArguments measure_;
};

}  // namespace

std::unique_ptr<Command> MakeRunCommand() { return std::make_unique<RunCommand>(); }

}  // namespace telestrain
