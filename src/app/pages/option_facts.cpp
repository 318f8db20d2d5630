#include "app/pages/option_facts.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/pages/offer.h"

namespace telestrain {
namespace {

std::vector<std::string> NamesOf(const CLI::Option& option) {
  if (option.get_positional()) return {option.get_name()};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> NamesOf(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::sort(names.begin(), names.end());  // the set is sorted by address
  return names;
}

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// CLI11 tells of a check only in the name of the type: "TEXT:{osmesa,egl}", "N:INT in [0 - 2]".
void ReadType(const std::string& type, OptionFacts* facts) {
  const std::size_t colon = type.find(':');
  facts->value = type.substr(0, colon);
  if (colon == std::string::npos) return;
  const std::string check = type.substr(colon + 1);
  if (check.starts_with('{') && check.ends_with('}')) {
    facts->choices = SplitAtCommas(check.substr(1, check.size() - 2));
    return;
  }
  const std::size_t open = check.find('['), dash = check.find(" - ", open);
  if (open != std::string::npos && dash != std::string::npos && check.ends_with(']'))
    facts->range = check.substr(open + 1, dash - open - 1) + " to " +
                   check.substr(dash + 3, check.size() - dash - 4);
}

OptionFacts FactsOf(const CLI::Option& option) {
  OptionFacts facts;
  facts.names = NamesOf(option);
  facts.is_argument = option.get_positional();
  facts.is_required = option.get_required();
  facts.least_values = option.get_items_expected_min();
  facts.most_values = option.get_items_expected_max();
  constexpr int kCounted = 4;  // who types more does not count them
  if (facts.most_values > kCounted) facts.most_values = OptionFacts::kManyValues;
  if (option.get_delimiter() != '\0') facts.most_values = facts.least_values = 1;
  if (facts.most_values > 0) ReadType(option.get_type_name(), &facts);
  facts.delimiter = option.get_delimiter();
  facts.default_value = option.get_default_str();
  facts.environment = option.get_envname();
  facts.needs = NamesOf(option.get_needs());
  facts.excludes = NamesOf(option.get_excludes());
  facts.help = option.get_description();
  if (facts.help.find(facts.range) != std::string::npos) facts.range.clear();  // said already
  return facts;
}

}  // namespace

std::string OptionFacts::Shown() const {
  const std::string many = most_values > 1 && most_values > least_values ? " …" : "";
  if (is_argument) return names.front() + many;
  std::string text = Joined(names, ", ");
  if (most_values == 0) return text;
  return text + " " + (choices.empty() ? value : Joined(choices, "|")) + many;
}

std::vector<OptionFacts> OptionsOf(const CLI::App& app) {
  std::vector<OptionFacts> all;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty() && option != app.get_help_ptr())
      all.push_back(FactsOf(*option));
  if (const CLI::Option* help = app.get_help_ptr()) all.push_back(FactsOf(*help));
  return all;
}

}  // namespace telestrain
