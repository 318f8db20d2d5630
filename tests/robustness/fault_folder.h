#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace telestrain::testing_support {

// What is wrong with the files below a results folder, each looked at by its kind: JSON parses,
// every line of .jsonl too, tables end with a whole line of as many fields as their heading,
// pictures are decoded, XML is closed, and the PDF is one by `qpdf --check`. Empty: nothing.
std::vector<std::string> BrokenFiles(const std::filesystem::path& folder);

// The bytes that a file of a results folder may have, by its path: those that it had before a
// program was started, and those of a run that nothing disturbs.
using FileBytes = std::map<std::string, std::string>;

// What of `folder` is neither old nor new: another file, other bytes, and, where `temporaries` is
// false, a temporary. A file that grows by lines (the trail, the pipe's states) may end after any
// whole line of the new one that is not before the old one's end.
std::vector<std::string> NeitherOldNorNew(const std::filesystem::path& folder,
                                          const FileBytes& before, const FileBytes& undisturbed,
                                          bool temporaries);

// Names of what was left by WriteFileAtomically.
std::vector<std::string> TemporariesIn(const std::filesystem::path& folder);

}  // namespace telestrain::testing_support
