#pragma once

#include <string>

namespace telestrain {

// The standard output (and error output) of a command line, and whether it ended with 0.
struct ToolRun {
  bool ok = false;
  std::string output;
};
ToolRun RunTool(const std::string& command_line);

// `text` without white space, so that line breaks of the layout do not count.
std::string WithoutSpace(const std::string& text);

// Reads `path` to the end.
std::string FileBytes(const std::string& path);

}  // namespace telestrain
