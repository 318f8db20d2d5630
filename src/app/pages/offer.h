#pragma once

#include <string>

#include "app/pages/option_facts.h"

namespace telestrain {

// What a completion can offer for a value.
enum class Offer { kNothing, kFiles, kFolders, kChoices, kChoiceList };  // the list by commas

Offer OfferOf(const OptionFacts& option);

// The words in single quotes for a shell; a quote among them ends the quotation, stands alone and
// begins it again.
std::string ShellQuoted(const std::string& text);

// Help of one line without what follows the first clause: completions have room for no more.
std::string ShortHelp(const OptionFacts& option);

std::string Joined(const std::vector<std::string>& words, const std::string& between);

}  // namespace telestrain
