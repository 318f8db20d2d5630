#include <CLI/CLI.hpp>

#include "app/pages/completion.h"
#include "app/pages/offer.h"

namespace telestrain {
namespace {

// In single quotes fish reads \' and \\ only.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c);
  return quoted + "'";
}

std::string Action(const OptionFacts& option) {
  switch (OfferOf(option)) {
    case Offer::kFiles:
      return "-F";
    case Offer::kFolders:
      return "-a '(__fish_complete_directories)'";
    case Offer::kChoices:
      return "-a " + Quoted(Joined(option.choices, " "));
    case Offer::kChoiceList:
      return "-a " + Quoted("(__fish_append , " + Joined(option.choices, " ") + ")");
    case Offer::kNothing:
      break;
  }
  return "";
}

std::string Line(const std::string& begin, const OptionFacts& option) {
  std::string line = begin;
  if (!option.is_argument) {
    for (const std::string& name : option.names)
      line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (option.most_values > 0) line += OfferOf(option) == Offer::kFiles ? " -r" : " -x";
  }
  const std::string action = option.most_values > 0 ? Action(option) : "";
  if (option.is_argument && action.empty()) return "";
  if (!action.empty()) line += " " + action;
  return line + " -d " + Quoted(ShortHelp(option)) + "\n";
}

// Only the verbs that stand on the line choose what is offered; the values of the program's own
// options, which come before, are none.
std::string Condition(const CLI::App& program, const std::string& function) {
  std::string with_value;
  for (const OptionFacts& option : OptionsOf(program))
    if (option.most_values > 0 && !option.is_argument)
      for (const std::string& name : option.names) with_value += " " + name;
  return "# Whether the verbs before the cursor are the given ones.\nfunction " + function +
         "\n"
         "    set -l words (commandline -opc)\n"
         "    set -e words[1]\n"
         "    while set -q words[1]; and string match -q -- '-*' $words[1]\n"
         "        if contains -- $words[1]" +
         with_value +
         "\n"
         "            set -e words[1]\n"
         "        end\n"
         "        set -e words[1]\n"
         "    end\n"
         "    if test $argv[1] = none\n"
         "        test (count $words) -eq 0\n"
         "    else if test $argv[-1] = only\n"
         "        test \"$words\" = \"$argv[1..-2]\"\n"
         "    else\n"
         "        set -l depth (count $argv)\n"
         "        test \"$words[1..$depth]\" = \"$argv\"\n"
         "    end\n"
         "end\n\n";
}

std::string Lines(const CLI::App& app, const std::string& command, const std::string& function,
                  const std::string& path) {
  const auto verbs = app.get_subcommands({});
  const std::string here = path.empty() ? "none" : path;
  const bool is_program_alone = path.empty() && verbs.empty();
  const std::string begin =
      command + (is_program_alone ? "" : " -n " + Quoted(function + " " + here));
  const std::string only =
      path.empty() ? begin : command + " -n " + Quoted(function + " " + here + " only");
  std::string text, below;
  for (const CLI::App* verb : verbs) {
    text += only + " -a " + verb->get_name() + " -d " + Quoted(verb->get_description()) + "\n";
    below += Lines(*verb, command, function, path + (path.empty() ? "" : " ") + verb->get_name());
  }
  for (const OptionFacts& option : OptionsOf(app)) text += Line(begin, option);
  return text + below;
}

}  // namespace

std::string FishCompletion(const CLI::App& program) {
  const std::string& name = program.get_name();
  const std::string command = "complete -c " + name, function = "__" + name + "_verbs_are";
  const bool has_verbs = !program.get_subcommands({}).empty();
  return "# Completion of " + name + " for fish; made from its tables of options.\n\n" +
         (has_verbs ? Condition(program, function) : "") + command + " -f\n" +
         Lines(program, command, function, "");
}

}  // namespace telestrain
