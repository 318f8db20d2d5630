#pragma once

#include <filesystem>

#include "base/result.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// Reads calibration.json, inputs.json and, when they are there, ruler.json, strain.json and the
// surface file of the state with the largest strain. Fails (kBadInput) with the file, the field,
// what was found and the command that makes the file again.
Result<Scene> SceneFromResults(const std::filesystem::path& results);

// The pipe part alone; empty when the folder has no strain.json.
Result<std::optional<Pipe>> PipeFromResults(const std::filesystem::path& results);

}  // namespace telestrain::viz
