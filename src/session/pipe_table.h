#pragma once

#include <filesystem>
#include <vector>

#include "session/session.h"

namespace telestrain {

// What a pipe.csv says.
struct PipeTable {
  std::vector<std::string> gauge_columns;
  std::vector<PipeState> states;
};

// A pipe.csv in any folder; its images need not be there yet. Every gauge whose place `session`
// says must have its column. Fails as ReadSession.
Result<PipeTable> ReadPipeTableOf(const Session& session, const std::filesystem::path& table);

}  // namespace telestrain
