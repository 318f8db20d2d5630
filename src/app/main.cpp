#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <exception>
#include <iostream>

#include "app/command.h"
#include "app/guarded_run.h"
#include "app/instrument_log.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/signals.h"

namespace telestrain {

void SessionArguments::AddTo(CLI::App& app) {
  app.add_option("SESSION", session, "session folder with session.toml, tables and images")
      ->required();
  app.add_option("--out", out, "results folder; made when it does not exist")->required();
}

void AddCornersOption(CLI::App& app, std::string& corners) {
  app.add_option(
      "--corners", corners,
      "corners.vnl (mrcal's format, from any detector) to use instead of the calibration "
      "images");
}

void CalibrateArguments::AddTo(CLI::App& app) {
  app.add_option("--compare", compare,
                 "an earlier calibration.json of this instrument: says what moved since, in um on "
                 "the object and in microstrain");
  app.add_option("--outliers", outliers,
                 "what becomes of corners that do not fit: removed beyond 5 sigma by the median "
                 "(median), by mrcal's rule with the sample's sigma (mrcal), or weighed down by "
                 "Cauchy's loss (weigh)")
      ->check(CLI::IsMember({"median", "mrcal", "weigh"}))
      ->capture_default_str();
  app.add_flag("--board-warp", board_warp,
               "estimate how the boards bow (as mrcal does), whether a test asks for it or not");
  app.add_option("--cull", culled,
                 "leave out the corners in X,Y,WIDTH,HEIGHT (px on the sensor); may be repeated");
}

void MeasureArguments::AddTo(CLI::App& app) {
  app.add_option("--subset-px", subset_px,
                 "odd side of the square subsets that are correlated (default: a sixteenth of the "
                 "shortest side of a view)");
  app.add_option("--step-px", step_px,
                 "distance between the subsets (default: their side); a smaller one gives a denser "
                 "map of points that are not independent");
}

void MeasureArguments::AddWatchTo(CLI::App& app) {
  auto* folder = app.add_option("--watch", watch,
                                "measure the images that arrive in this folder, until interrupted; "
                                "pipe.csv there or in the session names their load steps");
  app.add_option("--until", until, "end after so many states")->needs(folder);
  app.add_option("--idle-s", idle_s, "end after so many seconds without a new image")
      ->needs(folder);
}

namespace {

constexpr int kUsageExit = 2, kOutputExit = 5;
constexpr int kDefectExit = 70;

constexpr const char* kFooter =
    "Exit codes: 0 accepted, 1 measured but not accepted, 2 wrong usage, 3 bad input data,\n"
    "4 estimation failed, 5 rendering, report or a write failed (disk, memory, folder in use),\n"
    "70 a defect of the program, 128+N ended by signal N.\n"
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

// Says what failed and gives its exit code.
int Report(const std::string& verb, const Error& error, Console& console) {
  console.Note("telestrain " + verb + ": " + error.message);
  return static_cast<int>(error.kind);
}

// The results folder that a verb was given, by the name of its option; empty when it has none.
std::filesystem::path ResultsOf(const CLI::App& verb) {
  for (const char* name : {"RESULTS", "REPORT", "--out"})
    if (const auto* option = verb.get_option_no_throw(name); option && option->count() > 0) {
      const std::filesystem::path path = option->results().front();
      return std::string(name) == "REPORT" ? std::filesystem::absolute(path).parent_path() : path;
    }
  return {};
}

int RunCommand(Command& command, const CLI::App& verb, const InstrumentLog& log, LoggedRun run,
               Console& console) {
  if (const Status open = CheckLog(log); !open)
    return Report(command.Name(), open.error(), console);
  run.verb = command.Name();
  run.results = ResultsOf(verb);
  const Result<int> result = RunGuarded(command, log, run, console);
  run.exit_code = result ? *result : Report(command.Name(), result.error(), console);
  // A reader that has gone away wants no more; what was made is made.
  if (const int failed = console.OutError(); failed != 0 && failed != EPIPE)
    run.exit_code = Report(command.Name(), CannotWrite("standard output", failed), console);
  const NoSignalNow until_logged;
  if (const Status logged = LogRun(log, run); !logged)
    return Report(command.Name(), logged.error(), console);
  return run.exit_code;
}

void AddLogOptions(CLI::App& app, InstrumentLog& log) {
  app.add_option("--instrument-log", log.file,
                 "log of the instrument: every run adds a line, who did what when")
      ->envname("TELESTRAIN_INSTRUMENT_LOG");
  app.add_option("--instrument-key", log.key_file,
                 "Ed25519 key in PEM that signs the lines of the log")
      ->envname("TELESTRAIN_INSTRUMENT_KEY");
}

// The complaint about a first argument that is neither an option nor a verb; else empty.
std::string UnknownVerb(int argc, char** argv,
                        const std::vector<std::unique_ptr<Command>>& commands) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (word.empty() || word.front() == '-') return "";
  std::vector<std::string> verbs;
  for (const auto& command : commands) verbs.push_back(command->Name());
  if (std::find(verbs.begin(), verbs.end(), word) != verbs.end()) return "";
  return "telestrain: unknown verb '" + word + "'; the nearest verb is '" +
         NearestWord(word, verbs) + "'\nRun with --help for all verbs.";
}

int Main(int argc, char** argv) {
  CLI::App app{
      "telestrain calibrates a telecentric four-view camera array, proves it on a ruler, measures\n"
      "the strain of a pipe with it and writes the PDF acceptance report."};
  app.name("telestrain");
  app.set_version_flag("--version", "telestrain " TELESTRAIN_VERSION);
  app.require_subcommand(1);
  app.footer(kFooter);
  InstrumentLog log;
  AddLogOptions(app, log);
  auto commands = AllCommands();
  for (const auto& command : commands) {
    CLI::App* verb = app.add_subcommand(command->Name(), command->Summary());
    verb->footer("Example: " + command->Example());
    command->AddOptions(*verb);
  }
  if (const std::string complaint = UnknownVerb(argc, argv, commands); !complaint.empty()) {
    std::cerr << complaint << '\n';
    return kUsageExit;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    errno = 0;
    const int code = app.exit(e) == 0 ? 0 : kUsageExit;
    if (std::cout.flush() || errno == EPIPE) return code;
    std::cerr << "telestrain: " << CannotWrite("standard output", errno).message << '\n';
    return kOutputExit;
  }
  Console console(std::cout, std::cerr, ::isatty(STDERR_FILENO) != 0);
  for (const auto& command : commands)
    if (app.got_subcommand(command->Name()))
      return RunCommand(*command, *app.get_subcommand(command->Name()), log,
                        {{}, {argv + 1, argv + argc}, {}, 0}, console);
  return kUsageExit;
}

}  // namespace
}  // namespace telestrain

int main(int argc, char** argv) {
  telestrain::HandleSignals();
  telestrain::HandleLackOfMemory();
  try {
    return telestrain::Main(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << "telestrain: a defect of the program: " << e.what()
              << "\nPlease report it with the command line and the session.\n";
    return telestrain::kDefectExit;
  }
}
