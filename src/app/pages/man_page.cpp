#include "app/pages/man_page.h"

#include <CLI/CLI.hpp>

#include "app/exit_codes.h"
#include "app/pages/offer.h"
#include "app/pages/option_facts.h"
#include "app/pages/page_texts.h"
#include "app/pages/roff.h"

namespace telestrain {
namespace {

// A footer is keys of a window, exit codes, "Example: …" and, after an empty line, notes that keep
// their breaks; each may be missing, but without an example the keys go too.
struct Footer {
  std::string keys, examples, notes;
};

Footer ReadFooter(const CLI::App& app) {
  const std::string mark = "Example: ", text = app.get_footer();
  const std::size_t begin = text.find(mark);
  if (begin == std::string::npos) return {};
  const std::size_t from = begin + mark.size(),
                    end = std::min(text.find("\n\n", from), text.size());
  Footer footer{"", text.substr(from, end - from), ""};
  if (text.starts_with("Keys: ")) footer.keys = text.substr(0, text.find("\nExit codes"));
  for (std::size_t at; (at = footer.examples.find("\n  ")) != std::string::npos;)
    footer.examples.erase(at + 1, 2);  // indented for the terminal
  if (end < text.size()) footer.notes = text.substr(end + 2);
  return footer;
}

void WriteSynopsis(RoffPage& page, const std::string& command, const CLI::App& app) {
  std::string arguments, required;
  for (const OptionFacts& option : OptionsOf(app)) {
    const std::string shown = option.Shown();
    if (option.is_argument) arguments += (option.is_required ? shown : "[" + shown + "]") + " ";
    if (!option.is_argument && option.is_required) required += shown + " ";
  }
  const std::string verb = app.get_subcommands({}).empty() ? "" : " VERB …";
  page.Synopsis(command, arguments + required + "[OPTION …]" + verb);
}

void WriteOption(RoffPage& page, const OptionFacts& option) {
  std::string text = option.help;
  if (!option.range.empty()) text += "; " + option.range;
  if (!option.choices.empty() && option.is_argument)
    text += "; one of " + Joined(option.choices, ", ");
  if (option.is_required) text += "; required";
  if (!option.default_value.empty()) text += "; default: " + option.default_value;
  if (!option.environment.empty()) text += "; or from " + option.environment;
  if (!option.needs.empty()) text += "; needs " + Joined(option.needs, ", ");
  if (!option.excludes.empty()) text += "; not with " + Joined(option.excludes, ", ");
  page.TaggedOption(option.Shown(), text);
}

void WriteOptions(RoffPage& page, const CLI::App& app) {
  for (const OptionFacts& option : OptionsOf(app)) WriteOption(page, option);
}

void WriteNamed(RoffPage& page, const std::string& section, const std::vector<NamedText>& texts) {
  if (texts.empty()) return;
  page.Section(section);
  for (const NamedText& text : texts) page.Tagged(text.name, text.text);
}

void WriteEnvironment(RoffPage& page, const CLI::App& app, const PageText& text) {
  std::vector<NamedText> all = text.environment;
  std::vector<const CLI::App*> apps = {&app};
  for (const CLI::App* below : app.get_subcommands({})) apps.push_back(below);
  if (app.get_parent()) apps.push_back(app.get_parent());
  for (const CLI::App* with_options : apps)
    for (const OptionFacts& option : OptionsOf(*with_options))
      if (!option.environment.empty())
        all.push_back({option.environment, "the same as " + option.names.back()});
  for (const NamedText& common : CommonEnvironment()) all.push_back(common);
  WriteNamed(page, "ENVIRONMENT", all);
}

void WriteExitStatus(RoffPage& page, const PageText& text) {
  if (!text.exit_status.empty()) return WriteNamed(page, "EXIT STATUS", text.exit_status);
  page.Section("EXIT STATUS");
  for (const ExitCode& exit : kExitCodes) page.Tagged(exit.code, exit.meaning);
}

std::string PageName(const std::string& program, const std::string& page) {
  if (page.ends_with(')')) return page;
  return program + (page.empty() ? "" : "-" + page) + "(1)";
}

void WriteSeeAlso(RoffPage& page, const PageText& text) {
  page.Section("SEE ALSO");
  std::string names;
  if (!text.page.empty()) names = PageName("telestrain", "");
  for (const std::string& other : text.see_also)
    names += (names.empty() ? "" : ", ") + PageName("telestrain", other);
  page.Paragraph(names);
}

void WriteVerbsBelow(RoffPage& page, const CLI::App& app) {
  for (const CLI::App* below : app.get_subcommands({})) {
    page.Subsection(app.get_name() + " " + below->get_name() + ": " + below->get_description());
    WriteOptions(page, *below);
  }
}

void WriteListOfVerbs(RoffPage& page, const CLI::App& program) {
  page.Section("VERBS");
  for (const CLI::App* verb : program.get_subcommands({}))
    page.Tagged(PageName(program.get_name(), verb->get_name()), verb->get_description());
}

RoffPage Begin(const std::string& name, const std::string& summary, const PageStamp& stamp) {
  RoffPage page(name, stamp.date, "telestrain " + stamp.version);
  page.Section("NAME");
  page.Name(name, summary);
  page.Section("SYNOPSIS");
  return page;
}

void WriteRest(RoffPage& page, const CLI::App& app, const PageText& text) {
  WriteEnvironment(page, app, text);
  WriteExitStatus(page, text);
  WriteNamed(page, "FILES", text.files);
  if (const Footer footer = ReadFooter(app); !footer.examples.empty()) {
    page.Section("EXAMPLES");
    page.Lines(footer.examples);
  }
  WriteSeeAlso(page, text);
}

std::string VerbPage(const CLI::App& program, const CLI::App& verb, const PageStamp& stamp) {
  const PageText& text = PageTextOf(verb.get_name());
  const auto below = verb.get_subcommands({});
  RoffPage page = Begin(program.get_name() + "-" + verb.get_name(), verb.get_description(), stamp);
  const std::string command = program.get_name() + " " + verb.get_name();
  for (const CLI::App* app : below) WriteSynopsis(page, command + " " + app->get_name(), *app);
  if (below.empty()) WriteSynopsis(page, command, verb);
  page.Section("DESCRIPTION");
  page.Paragraph(text.description);
  if (const Footer footer = ReadFooter(verb); !footer.notes.empty()) page.Lines(footer.notes);
  page.Section("OPTIONS");
  WriteOptions(page, verb);
  WriteVerbsBelow(page, verb);
  WriteRest(page, verb, text);
  return page.text();
}

std::string ProgramPage(const CLI::App& program, const PageStamp& stamp) {
  const std::string name = program.get_name();
  const bool has_verbs = !program.get_subcommands({}).empty();
  const PageText& text = PageTextOf(has_verbs ? "" : name.substr(name.find('-') + 1));
  RoffPage page = Begin(name, text.summary, stamp);
  WriteSynopsis(page, name, program);
  page.Section("DESCRIPTION");
  page.Paragraph(text.description);
  if (const std::string keys = ReadFooter(program).keys; !keys.empty()) page.NextParagraph(keys);
  if (has_verbs) WriteListOfVerbs(page, program);
  page.Section("OPTIONS");
  WriteOptions(page, program);
  WriteRest(page, program, text);
  return page.text();
}

}  // namespace

std::map<std::string, std::string> ManPages(const CLI::App& program, const PageStamp& stamp) {
  std::map<std::string, std::string> pages;
  pages[program.get_name() + ".1"] = ProgramPage(program, stamp);
  for (const CLI::App* verb : program.get_subcommands({}))
    pages[program.get_name() + "-" + verb->get_name() + ".1"] = VerbPage(program, *verb, stamp);
  return pages;
}

}  // namespace telestrain
