#include "app/command.h"
#include "app/steps.h"

// clang-format off
// telestrain detect SESSION --out RESULTS
//   detect     93 of 96 board views used, 48 of 48 ruler crosses
// clang-format on

namespace telestrain {
namespace {

class DetectCommand : public Command {
 public:
  std::string Name() const override { return "detect"; }
  std::string Summary() const override {
    return "find the corners of the target and the crosses of the ruler in every view";
  }
  std::string Example() const override { return "telestrain detect session --out results"; }
  void AddOptions(CLI::App& app) override {
    arguments_.AddTo(app);
    AddCornersOption(app, corners_);
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_ASSIGN_OR_RETURN(ResultsLock lock, ResultsLock::Take(arguments_.out));
    TELESTRAIN_ASSIGN_OR_RETURN(const Session session,
                                OpenSession(arguments_.session, arguments_.out, corners_, lock));
    TELESTRAIN_RETURN_IF_ERROR(DetectStep(session, arguments_.out, corners_, console));
    return 0;
  }

 private:
  SessionArguments arguments_;
  std::string corners_;
};

}  // namespace

std::unique_ptr<Command> MakeDetectCommand() { return std::make_unique<DetectCommand>(); }

}  // namespace telestrain
