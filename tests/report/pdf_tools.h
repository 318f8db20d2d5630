#pragma once

#include <string>

// Skips the running test when the tool is not installed.
#define NEEDS_TOOL(path, name) \
  if (std::string(path).empty()) GTEST_SKIP() << name << " is not installed"

namespace telestrain {

// The standard output (and error output) of a command line, and whether it ended with 0.
struct ToolRun {
  bool ok = false;
  std::string output;
};
ToolRun RunTool(const std::string& command_line);

// `text` without white space, so that line breaks of the layout do not count.
std::string WithoutSpace(const std::string& text);

// The command line of PDFBox's preflight for PDF/A-1b, wanting a file; empty without java or one of
// its jars.
std::string PreflightCommand();

// Reads `path` to the end.
std::string FileBytes(const std::string& path);

}  // namespace telestrain
