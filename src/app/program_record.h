#pragma once

#include <nlohmann/json_fwd.hpp>

namespace telestrain {

// Name and version of this program and of the libraries that it was built with. For results, whose
// bytes must be equal wherever and whenever one version is built: the revision of the source and
// the build are in the instrument's log and in --version only.
nlohmann::ordered_json ProgramRecord();

// The machine, as far as numbers may depend on it: architecture and the processor's vector
// instructions. For the instrument's log only; results of equal inputs must not differ by it.
nlohmann::ordered_json HostRecord();

}  // namespace telestrain
