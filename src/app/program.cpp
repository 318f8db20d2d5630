#include "app/program.h"

#include <CLI/CLI.hpp>

namespace telestrain {
namespace {

constexpr const char* kFooter =
    "Exit codes: 0 accepted, 1 measured but not accepted, 2 wrong usage, 3 bad input data,\n"
    "4 estimation failed, 5 rendering or report failed, 70 a defect of the program.\n"
    "Help for one verb: telestrain VERB --help";

std::vector<std::unique_ptr<Command>> AllCommands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(MakeRunCommand());
  commands.push_back(MakeDetectCommand());
  commands.push_back(MakeCalibrateCommand());
  commands.push_back(MakeDiagnoseCommand());
  commands.push_back(MakeVerifyCommand());
  commands.push_back(MakeMeasureCommand());
  commands.push_back(MakeRenderCommand());
  commands.push_back(MakeReportCommand());
  commands.push_back(MakeReviewCommand());
  commands.push_back(MakeSignCommand());
  commands.push_back(MakeExportCommand());
  commands.push_back(MakeSimulateCommand());
  commands.push_back(MakeStudyCommand());
  commands.push_back(MakeDesignCommand());
  commands.push_back(MakeCorrelateCommand());
  commands.push_back(MakeAuditCommand());
  return commands;
}

void AddLogOptions(CLI::App& app, InstrumentLog& log) {
  app.add_option("--instrument-log", log.file,
                 "log of the instrument: every run adds a line, who did what when")
      ->envname("TELESTRAIN_INSTRUMENT_LOG");
  app.add_option("--instrument-key", log.key_file,
                 "Ed25519 key in PEM that signs the lines of the log")
      ->envname("TELESTRAIN_INSTRUMENT_KEY");
}

}  // namespace

Program::Program() : app_(std::make_unique<CLI::App>()), commands_(AllCommands()) {
  app_->description(
      "telestrain calibrates a telecentric four-view camera array, proves it on a ruler, measures\n"
      "the strain of a pipe with it and writes the PDF acceptance report.");
  app_->name("telestrain");
  app_->set_version_flag("--version", "telestrain " TELESTRAIN_VERSION);
  app_->require_subcommand(1);
  app_->footer(kFooter);
  AddLogOptions(*app_, log_);
  settings_.AddTo(*app_);
  for (const auto& command : commands_) {
    CLI::App* verb = app_->add_subcommand(command->Name(), command->Summary());
    verb->footer("Example: " + command->Example());
    command->AddOptions(*verb);
  }
}

Program::~Program() = default;

std::vector<std::string> Program::Verbs() const {
  std::vector<std::string> verbs;
  for (const auto& command : commands_) verbs.push_back(command->Name());
  return verbs;
}

Command* Program::Chosen() const {
  for (const auto& command : commands_)
    if (app_->got_subcommand(command->Name())) return command.get();
  return nullptr;
}

}  // namespace telestrain
