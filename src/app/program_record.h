#pragma once

#include <nlohmann/json_fwd.hpp>

namespace telestrain {

// Name and version of this program and of the libraries that it was built with.
nlohmann::ordered_json ProgramRecord();

// The machine, as far as numbers may depend on it: architecture and the processor's vector
// instructions. For the instrument's log only; results of equal inputs must not differ by it.
nlohmann::ordered_json HostRecord();

}  // namespace telestrain
