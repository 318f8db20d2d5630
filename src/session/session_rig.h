#pragma once

#include <filesystem>

#include "base/result.h"
#include "optics/optical_rig.h"
#include "session/session.h"

namespace telestrain {

// The instrument that a session describes, for ray tracing. The field that it has to have along the
// pipe is what the target's corners and the ruler take. Fails (kBadInput) when the views are not
// given by mirrors and says what to add.
Result<OpticalRig> RigOfSession(const Session& session);

// The same from a session.toml, or from the one in a folder; no table and no image has to exist.
Result<OpticalRig> ReadRig(const std::filesystem::path& session_or_file);

}  // namespace telestrain
