#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace telestrain::testing_support {

// One command of a document and what the document shows of it.
struct ShownCommand {
  int line = 0;  // in the document, from 1
  std::string command;
  int exit_code = 0;                // from a trailing comment `# exit code N`
  std::vector<std::string> output;  // shown lines; '…' stands for anything, alone for any lines
  bool shown = true;                // false: of a hidden `<!-- run: … -->`
};

// A block of commands that the tests leave out, as `<!-- not run: REASON -->` before it says.
struct UntestedBlock {
  int line = 0;
  std::string reason;
  std::vector<std::string> commands;
};

struct Table {
  int line = 0;
  std::vector<std::string> rows;  // as written
  std::string source;             // of a `<!-- figures: SOURCE -->` before it; else empty
};

struct Link {
  int line = 0;
  std::string target;  // as written, without a title
};

// A Markdown document as the tests see it. Commands stand in fenced or indented blocks whose first
// word is a program that IsCommandWord knows; a line of such a block that begins with one is a
// command (a backslash at its end continues it), any other is output of the command before.
struct Document {
  std::filesystem::path path;
  std::string text;
  std::vector<std::string> lines;
  std::vector<ShownCommand> commands;
  std::vector<UntestedBlock> untested;
  std::vector<Table> tables;
  std::vector<Link> links;              // outside of code
  std::vector<std::string> code_spans;  // `…` outside of blocks
  std::vector<std::string> anchors;     // of the headings, as GitHub makes them
};

bool IsCommandWord(const std::string& word);

Document ReadDocument(const std::filesystem::path& path);

// Every Markdown file of the project, the build folder and hidden folders left out.
std::vector<std::filesystem::path> DocumentPaths(const std::filesystem::path& project);

// Whether `shown` with its '…' describes the lines of `printed`; empty lines do not count.
bool DescribesOutput(const std::vector<std::string>& shown, const std::string& printed);

}  // namespace telestrain::testing_support
