#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace telestrain {

// What an audit wants to know of the program: version, revision of the source, build, libraries as
// compiled against and as loaded, formats written, vector instructions in use, licence.
nlohmann::ordered_json VersionRecord();

// The same as lines of "key: value" below "telestrain VERSION"; a library of which another version
// is loaded than it was compiled against is marked "(differs)".
std::string VersionText();

// The name of this build, a hash that the linker made of it; empty where there is none.
std::string BuildId();

}  // namespace telestrain
