#include "app/command.h"
#include "app/steps.h"

// clang-format off
// telestrain measure SESSION --out RESULTS
//   measure    6 states, 475 surface points, pipe diameter 8.0004 mm
// clang-format on

namespace telestrain {
namespace {

class MeasureCommand : public Command {
 public:
  std::string Name() const override { return "measure"; }
  std::string Summary() const override { return "measure the strain of the pipe in every state"; }
  std::string Example() const override { return "telestrain measure session --out results"; }
  void AddOptions(CLI::App& app) override {
    arguments_.AddTo(app);
    choices_.AddTo(app);
    choices_.AddWatchTo(app);
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_ASSIGN_OR_RETURN(const MeasureChoices choices, ReadChoices(choices_));
    TELESTRAIN_ASSIGN_OR_RETURN(const ResultsLock lock, ResultsLock::Take(arguments_.out));
    TELESTRAIN_ASSIGN_OR_RETURN(const Session session,
                                ReopenSession(arguments_.session, arguments_.out));
    TELESTRAIN_RETURN_IF_ERROR(MeasureStep(session, arguments_.out, choices, console));
    return 0;
  }

 private:
  SessionArguments arguments_;
  MeasureArguments choices_;
};

}  // namespace

std::unique_ptr<Command> MakeMeasureCommand() { return std::make_unique<MeasureCommand>(); }

}  // namespace telestrain
