#include "app/pages/options_markdown.h"

#include <CLI/CLI.hpp>

#include "app/pages/option_facts.h"

namespace telestrain {
namespace {

// A cell may hold no bar that ends it and no line feed; < would begin a tag.
std::string Cell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += "\\|";
    if (c == '\n') cell += ' ';
    if (c == '<') cell += "&lt;";
    if (c != '|' && c != '\n' && c != '<') cell += c;
  }
  return cell;
}

std::string Code(const std::string& text) { return "`" + Cell(text) + "`"; }

std::string ListOf(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? " " : ", ") + Code(name);
  return text;
}

std::string DefaultOf(const OptionFacts& option) {
  if (option.is_required) return "required";
  return option.default_value.empty() ? "" : Code(option.default_value);
}

std::string HelpOf(const OptionFacts& option) {
  std::string text = Cell(option.help);
  if (!option.range.empty()) text += "; " + option.range;
  if (!option.environment.empty()) text += "; or from " + Code(option.environment);
  if (!option.needs.empty()) text += "; needs" + ListOf(option.needs);
  if (!option.excludes.empty()) text += "; not with" + ListOf(option.excludes);
  return text;
}

std::string Table(const CLI::App& app) {
  std::string text = "| option | default | what it does |\n|---|---|---|\n";
  for (const OptionFacts& option : OptionsOf(app))
    text +=
        "| " + Code(option.Shown()) + " | " + DefaultOf(option) + " | " + HelpOf(option) + " |\n";
  return text;
}

}  // namespace

std::string OptionsMarkdown(const CLI::App& verb) {
  const auto verbs = verb.get_subcommands({});
  if (verbs.empty()) return Table(verb);
  std::string text;
  for (const CLI::App* below : verbs)
    text += (text.empty() ? "### " : "\n### ") + verb.get_name() + " " + below->get_name() + ": " +
            below->get_description() + "\n\n" + Table(*below);
  return text;
}

std::string WithOptions(const std::string& page, const CLI::App& verb) {
  const std::string begin = std::string(kOptionsBegin) + "\n";
  const std::size_t from = page.find(begin), to = page.find(kOptionsEnd);
  if (from == std::string::npos || to == std::string::npos || to < from) return "";
  return page.substr(0, from + begin.size()) + OptionsMarkdown(verb) + page.substr(to);
}

}  // namespace telestrain
