#include "app/command.h"
#include "app/steps.h"

// clang-format off
// telestrain verify SESSION --out RESULTS
//   verify     12 ruler lengths, error mean 0.002 um, sd 0.008 um, largest 0.020 um
// clang-format on

namespace telestrain {
namespace {

class VerifyCommand : public Command {
 public:
  std::string Name() const override { return "verify"; }
  std::string Summary() const override {
    return "measure the ruler with the calibration and compare it with its certificate";
  }
  std::string Example() const override { return "telestrain verify session --out results"; }
  void AddOptions(CLI::App& app) override { arguments_.AddTo(app); }
  Result<int> Run(Console& console) override {
    TELESTRAIN_ASSIGN_OR_RETURN(const ResultsLock lock, ResultsLock::Take(arguments_.out));
    TELESTRAIN_ASSIGN_OR_RETURN(const Session session,
                                ReopenSession(arguments_.session, arguments_.out));
    TELESTRAIN_RETURN_IF_ERROR(VerifyStep(session, arguments_.out, console));
    return 0;
  }

 private:
  SessionArguments arguments_;
};

}  // namespace

std::unique_ptr<Command> MakeVerifyCommand() { return std::make_unique<VerifyCommand>(); }

}  // namespace telestrain
