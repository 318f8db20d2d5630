#pragma once

#include <map>
#include <string>

namespace CLI {
class App;
}

namespace telestrain {

// What stands at the foot of every manual page.
struct PageStamp {
  std::string date;     // of the version, ISO 8601
  std::string version;  // "0.1.0"
};

// The manual pages of a program by their file names: telestrain.1 and a page per verb
// (telestrain-run.1), or the one page of a program without verbs. Names, options and values come
// from the table of options, all else from page_texts.h.
std::map<std::string, std::string> ManPages(const CLI::App& program, const PageStamp& stamp);

}  // namespace telestrain
