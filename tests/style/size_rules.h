#pragma once

#include "style/source_file.h"

namespace telestrain::style {

inline constexpr int kMaxFileLines = 400;
inline constexpr int kWantedFileLines = 300;
inline constexpr int kMaxFunctionLines = 60;
inline constexpr int kWantedFunctionLines = 40;
inline constexpr int kMaxNesting = 3;

// One function body found in a file; lines count from 1 and include signature and brace.
struct Function {
  std::string signature;  // its first line
  int first_line = 0;
  int lines = 0;
  int nesting = 0;  // braces of if, for, while, switch, do, else, try, catch inside one another
};

// The functions of C++ code in the layout that clang-format makes. Finds bodies by what stands
// before their brace, so it needs no compiler; lambdas count as a part of their function.
std::vector<Function> FunctionsOf(std::string_view text);

// More than kMaxFileLines lines.
Findings CheckFileSize(const SourceFile& file);

// More than kMaxFunctionLines lines or kMaxNesting levels.
Findings CheckFunctions(const SourceFile& file);

// What is allowed but above the wanted size.
Findings SizeWarnings(const SourceFile& file);

}  // namespace telestrain::style
