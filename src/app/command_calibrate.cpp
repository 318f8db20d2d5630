#include "app/command.h"
#include "app/steps.h"

// clang-format off
// telestrain calibrate SESSION --out RESULTS
//   calibrate  magnification 227.3823 px/mm, lens model k1 p1 p2, reprojection RMS 0.0022 px over 10881 corners
// clang-format on

namespace telestrain {
namespace {

class CalibrateCommand : public Command {
 public:
  std::string Name() const override { return "calibrate"; }
  std::string Summary() const override {
    return "calibrate lens and views from the detected corners";
  }
  std::string Example() const override { return "telestrain calibrate session --out results"; }
  void AddOptions(CLI::App& app) override {
    arguments_.AddTo(app);
    AddCornersOption(app, corners_);
    choices_.AddTo(app);
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_ASSIGN_OR_RETURN(const CalibrateChoices choices, ReadChoices(choices_));
    TELESTRAIN_ASSIGN_OR_RETURN(ResultsLock lock, ResultsLock::Take(arguments_.out));
    TELESTRAIN_ASSIGN_OR_RETURN(
        const Session session,
        corners_.empty() ? ReopenSession(arguments_.session, arguments_.out)
                         : OpenSession(arguments_.session, arguments_.out, corners_, lock));
    if (!corners_.empty())
      TELESTRAIN_RETURN_IF_ERROR(DetectStep(session, arguments_.out, corners_, console));
    TELESTRAIN_RETURN_IF_ERROR(CalibrateStep(session, arguments_.out, choices, console));
    return 0;
  }

 private:
  SessionArguments arguments_;
  std::string corners_;
  CalibrateArguments choices_;
};

}  // namespace

std::unique_ptr<Command> MakeCalibrateCommand() { return std::make_unique<CalibrateCommand>(); }

}  // namespace telestrain
