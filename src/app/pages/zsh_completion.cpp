#include <CLI/CLI.hpp>

#include "app/pages/completion.h"
#include "app/pages/offer.h"

namespace telestrain {
namespace {

// What _arguments would read as the end of a part.
std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string Action(const OptionFacts& option) {
  switch (OfferOf(option)) {
    case Offer::kFiles:
      return "_files";
    case Offer::kFolders:
      return "_files -/";
    case Offer::kChoices:
      return "(" + Joined(option.choices, " ") + ")";
    case Offer::kChoiceList:
      return "_values -s , " + option.value + " " + Joined(option.choices, " ");
    case Offer::kNothing:
      break;
  }
  return " ";
}

std::string ValuePart(const OptionFacts& option) {
  return ":" + Escaped(option.value) + ":" + Action(option);
}

std::string ArgumentSpec(const OptionFacts& option) {
  const std::string many = option.most_values == OptionFacts::kManyValues ? "*" : "";
  return many + ":" + (option.is_required ? "" : ":") + Escaped(option.names.front()) + ":" +
         Action(option);
}

// A spec per name; the names of one option exclude each other.
std::vector<std::string> OptionSpecs(const OptionFacts& option) {
  const bool any_number = option.most_values == OptionFacts::kManyValues;
  std::string rest = "[" + Escaped(ShortHelp(option)) + "]";
  for (int i = 0; i < (any_number ? 1 : option.most_values); ++i) rest += ValuePart(option);
  std::vector<std::string> specs;
  for (const std::string& name : option.names) {
    const std::string before =
        any_number ? "*" : (option.names.size() > 1 ? "(" + Joined(option.names, " ") + ")" : "");
    specs.push_back(before + name + (option.most_values == 1 ? "=" : "") + rest);
  }
  return specs;
}

std::string FunctionName(const std::string& path) {
  std::string name = "_" + path;
  for (char& c : name)
    if (c == '-' || c == ' ') c = '_';
  return name;
}

std::string Verbs(const CLI::App& app, const std::string& path) {
  std::string words, calls;
  for (const CLI::App* verb : app.get_subcommands({})) {
    words +=
        "        " + ShellQuoted(verb->get_name() + ":" + Escaped(verb->get_description())) + "\n";
    calls += "        " + verb->get_name() + ") " + FunctionName(path + " " + verb->get_name()) +
             " ;;\n";
  }
  return "  case $state in\n    verb)\n      local -a verbs=(\n" + words +
         "      )\n      _describe verb verbs\n      ;;\n    rest)\n      case $line[1] in\n" +
         calls + "      esac\n      ;;\n  esac\n";
}

std::string Functions(const CLI::App& app, const std::string& path) {
  const bool has_verbs = !app.get_subcommands({}).empty();
  std::string text = FunctionName(path) + "() {\n";
  if (has_verbs) text += "  local state line\n  typeset -A opt_args\n";
  text += has_verbs ? "  _arguments -C" : "  _arguments";
  for (const OptionFacts& option : OptionsOf(app))
    for (const std::string& spec :
         option.is_argument ? std::vector<std::string>{ArgumentSpec(option)} : OptionSpecs(option))
      text += " \\\n    " + ShellQuoted(spec);
  if (has_verbs) text += " \\\n    '1:verb:->verb' '*::argument:->rest'";
  text += "\n" + (has_verbs ? Verbs(app, path) : "") + "}\n\n";
  for (const CLI::App* verb : app.get_subcommands({}))
    text += Functions(*verb, path + " " + verb->get_name());
  return text;
}

}  // namespace

std::string ZshCompletion(const CLI::App& program) {
  const std::string& name = program.get_name();
  return "#compdef " + name + "\n# Completion of " + name +
         " for zsh; made from its tables of options.\n\n" + Functions(program, name) +
         FunctionName(name) + " \"$@\"\n";
}

}  // namespace telestrain
