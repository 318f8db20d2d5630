#pragma once

#include <string>
#include <vector>

namespace telestrain {

struct NamedText {
  std::string name, text;
};

// What a manual page says beside the options.
struct PageText {
  std::string page;         // "run" for telestrain-run(1); "" for telestrain(1)
  std::string summary;      // of a program; a verb's stands with its options
  std::string description;  // paragraphs, an empty line between two
  std::vector<NamedText> files;
  std::vector<NamedText> environment;       // beside the variables that give options
  std::vector<std::string> see_also;        // pages, as in `page`; or a name with its section
  std::vector<NamedText> exit_status = {};  // empty: that of exit_codes.h
};

// Throws (a broken contract) when there is none: every verb has one.
const PageText& PageTextOf(const std::string& page);

// Variables and exit codes of every verb.
const std::vector<NamedText>& CommonEnvironment();

}  // namespace telestrain
