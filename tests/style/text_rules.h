#pragma once

#include <cstdint>

#include "style/source_file.h"

namespace telestrain::style {

// No tabs, trailing blanks or carriage returns; ends with one line end.
Findings CheckBlanks(const SourceFile& file);

// No notes of unfinished work in capitals.
Findings CheckBannedWords(const SourceFile& file);

// No absolute path of somebody's machine.
Findings CheckMachinePaths(const SourceFile& file);

// A header starts with `#pragma once` and explains itself in at least one comment line.
Findings CheckHeaderComment(const SourceFile& file);

// No catch-all file names.
Findings CheckFileName(std::string_view path);

// Every .cpp file of a module and every *_test.cpp is named in the CMakeLists.txt of its own
// folder or, by its path from there, of the nearest folder above that has one.
Findings CheckListedInCMake(const std::vector<SourceFile>& files);

// Names at the top of the repository; a name with a dot in front is always allowed.
Findings CheckTopLevel(const std::vector<std::string>& names);

struct FileSize {
  std::string path;
  std::uintmax_t bytes = 0;
};

// data/ stays below 20 MB, each of its files below 5 MB.
Findings CheckDataSize(const std::vector<FileSize>& files);

}  // namespace telestrain::style
