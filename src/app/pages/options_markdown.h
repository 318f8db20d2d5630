#pragma once

#include <string>

namespace CLI {
class App;
}

namespace telestrain {

// The options of a verb as a table in Markdown, a row per option with what it takes, its default
// and what it does; of a verb with verbs (audit) one table under a heading (###) for each. Ends
// with a line feed. src/app/pages/VERB.md holds it between the lines of kOptionsBegin and
// kOptionsEnd.
std::string OptionsMarkdown(const CLI::App& verb);

inline constexpr const char* kOptionsBegin = "<!-- options: made by telestrain_pages -->";
inline constexpr const char* kOptionsEnd = "<!-- options end -->";

// The page with the options between its two marks replaced; empty when the marks are not there.
std::string WithOptions(const std::string& page, const CLI::App& verb);

}  // namespace telestrain
