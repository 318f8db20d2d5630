#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <exception>
#include <iostream>
#include <optional>

#include "app/exit_codes.h"
#include "app/guarded_run.h"
#include "app/instrument_log.h"
#include "app/program.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/signals.h"
#include "base/utf8.h"

namespace telestrain {
namespace {

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
  std::optional<AtSignal> at_end(std::in_place,
                                 [&log, run](int signal) { return EndLogged(log, run, signal); });
  const Result<int> result = RunGuarded(command, console);
  run.exit_code = result ? *result : Report(command.Name(), result.error(), console);
  // A reader that has gone away wants no more; what was made is made.
  if (const int failed = console.OutError(); failed != 0 && failed != EPIPE)
    run.exit_code = Report(command.Name(), CannotWrite("standard output", failed), console);
  const NoSignalNow until_logged;
  at_end.reset();
  if (const Status logged = LogRun(log, run); !logged)
    return Report(command.Name(), logged.error(), console);
  return run.exit_code;
}

std::vector<std::string> OptionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// The complaint about the first verb or long option that the program does not know, before the
// parser says what else is missing; else empty.
std::string UnknownWord(int argc, char** argv, const CLI::App& program) {
  const CLI::App* app = &program;
  std::string path = "telestrain";
  const auto complaint = [&](const std::string& kind, const std::string& word,
                             const std::vector<std::string>& known) {
    return path + ": unknown " + kind + " '" + PrintableText(word) + "'; the nearest " + kind +
           " is '" + NearestWord(word, known) + "'\nRun '" + path + " --help' for all of them.";
  };
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i], name = word.substr(0, word.find('='));
    if (word == "--") return "";
    if (word.starts_with("--")) {
      const CLI::Option* option = app->get_option_no_throw(name);
      if (option == nullptr) option = program.get_option_no_throw(name);
      if (option == nullptr) return complaint("option", name, OptionNames(*app));
      if (name == word && option->get_items_expected_max() > 0) ++i;  // its value
      continue;
    }
    const auto verbs = app->get_subcommands([](const CLI::App*) { return true; });
    if (word.starts_with("-") || verbs.empty()) continue;
    std::vector<std::string> names;
    for (const CLI::App* verb : verbs) names.push_back(verb->get_name());
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) return complaint("verb", word, names);
    app = verbs[static_cast<std::size_t>(found - names.begin())];
    path += " " + word;
  }
  return "";
}

// What the parser says, for the verb as far as it was read.
std::string WrongUsage(const CLI::App* app, const CLI::Error& error) {
  std::string path = "telestrain";
  for (auto verbs = app->get_subcommands(); !verbs.empty(); verbs = app->get_subcommands()) {
    app = verbs.front();
    path += " " + app->get_name();
  }
  return path + ": " + error.what() + "\nRun '" + path + " --help' for what it takes.\n";
}

int Main(int argc, char** argv) {
  Program program;
  program.app().failure_message(WrongUsage);
  if (const std::string complaint = UnknownWord(argc, argv, program.app()); !complaint.empty()) {
    std::cerr << complaint << '\n';
    return kUsageExit;
  }
  CLI::App& app = program.app();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    errno = 0;
    const int code = app.exit(e) == 0 ? 0 : kUsageExit;
    if (std::cout.flush() || errno == EPIPE) return code;
    std::cerr << "telestrain: " << CannotWrite("standard output", errno).message << '\n';
    return kOutputExit;
  }
  Command* command = program.Chosen();
  if (!command) return kUsageExit;
  Console console(std::cout, std::cerr, ::isatty(STDERR_FILENO) != 0);
  if (const Status applied = program.settings().Apply(); !applied)
    return Report(command->Name(), applied.error(), console);
  return RunCommand(*command, *app.get_subcommand(command->Name()), program.log(),
                    {{}, {argv + 1, argv + argc}, {}, 0}, console);
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
