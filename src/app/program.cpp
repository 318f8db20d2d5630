#include "app/program.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/exit_codes.h"
#include "app/version_text.h"
#include "base/value_names.h"

namespace telestrain {
namespace {

std::string Footer() {
  std::string text = "Exit codes:";
  std::size_t line = 0;  // where the last one begins
  for (const ExitCode& exit : kExitCodes) {
    const std::string item = exit.code + std::string(" ") + exit.meaning;
    constexpr std::size_t kWidth = 90;
    const bool breaks = text.size() - line + item.size() + 2 > kWidth;
    if (breaks) line = text.size() + 1;
    text += (breaks ? "\n" : " ") + item + (&exit == &kExitCodes.back() ? "." : ",");
  }
  return text + "\nHelp for one verb: telestrain VERB --help";
}

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
      ->type_name(kFile)
      ->envname("TELESTRAIN_INSTRUMENT_LOG");
  app.add_option("--instrument-key", log.key_file,
                 "Ed25519 key in PEM that signs the lines of the log")
      ->type_name(kFile)
      ->envname("TELESTRAIN_INSTRUMENT_KEY");
}

// The options are read in their order, so all others are known when --version speaks.
void AddVersionOptions(CLI::App& app, const ProcessSettings& settings, bool& as_json) {
  auto* json = app.add_flag("--json", as_json, "--version as JSON");
  json->needs(app.set_version_flag(
      "--version",
      [&settings, &as_json] {
        if (const Status applied = settings.Apply(); !applied)
          throw CLI::ValidationError(applied.error().message);
        return as_json ? VersionRecord().dump(2) : VersionText();
      },
      "what this program is, a fact a line, and exit"));
}

}  // namespace

Program::Program() : app_(std::make_unique<CLI::App>()), commands_(AllCommands()) {
  app_->description(
      "telestrain calibrates a telecentric four-view camera array, proves it on a ruler, measures\n"
      "the strain of a pipe with it and writes the PDF acceptance report.");
  app_->name("telestrain");
  app_->require_subcommand(1);
  app_->footer(Footer());
  AddLogOptions(*app_, log_);
  settings_.AddTo(*app_);
  AddVersionOptions(*app_, settings_, as_json_);
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
