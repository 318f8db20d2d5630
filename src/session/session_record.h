#pragma once

#include <nlohmann/json_fwd.hpp>

#include "session/session.h"

namespace telestrain {

// What a session says, as it stands in inputs.json of a results folder: steps that read results
// only need nothing else of the session. `camera` and a view's `mirrors` stand in it when the
// session gives them; pipe states are not part of it.
nlohmann::ordered_json SessionRecord(const Session& session);

// The session of a record, without folder and pipe states. Throws
// nlohmann::json::exception when a key is missing or of another type.
Session SessionOfRecord(const nlohmann::ordered_json& record);

}  // namespace telestrain
