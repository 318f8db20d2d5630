#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace telestrain::testing_support {

// A message as the source builds it: its literal parts, with '…' for every part known at run time.
struct SourceMessage {
  std::string place;  // file:line below the project
  std::string text;
};

// The messages handed to BadInput, EstimationFailed, OutputFailed, WrongUsage, CannotRemove,
// Error{kind, …}, Warn and Doubt in C++ code. A message without a literal part of its own is left
// out.
std::vector<SourceMessage> MessagesOf(const std::string& code, const std::string& name);

// Those of every source of a module, such as "src/session".
std::vector<SourceMessage> MessagesOfModule(const std::filesystem::path& project,
                                            const std::string& module);

// Whether the pieces of `pattern` between its '…' occur one after the other in the text.
bool IsIn(const std::string& pattern, const std::string& text);

}  // namespace telestrain::testing_support
