#pragma once

#include <filesystem>
#include <vector>

#include "session/session.h"

namespace telestrain {

// The rows of a pipe.csv in any folder; its images need not be there yet. Fails as ReadSession.
Result<std::vector<PipeState>> ReadPipeStates(const std::filesystem::path& table);

}  // namespace telestrain
