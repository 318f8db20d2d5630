#include "app/pages/offer.h"

#include <algorithm>

#include "base/value_names.h"

namespace telestrain {

Offer OfferOf(const OptionFacts& option) {
  if (!option.choices.empty())
    return option.delimiter == ',' ? Offer::kChoiceList : Offer::kChoices;
  if (option.value == kFile || option.value == kPath) return Offer::kFiles;
  return option.value == kFolder ? Offer::kFolders : Offer::kNothing;
}

std::string ShellQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string ShortHelp(const OptionFacts& option) {
  const std::string& help = option.help;
  std::size_t end = help.size();
  for (const char* mark : {"; ", ". ", ": ", " (", " ["}) end = std::min(end, help.find(mark));
  return help.substr(0, end);
}

std::string Joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace telestrain
