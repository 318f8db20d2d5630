#pragma once

#include <filesystem>

#include "base/result.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// Reads all that a scene shows: inputs.json and calibration.json and, when they are there,
// residuals.csv, ruler.json, strain.json and the pipe_NNN.vtp of every state. Fails (kBadInput)
// with the file, the field, what was found and the command that makes the file again.
Result<Scene> SceneFromResults(const std::filesystem::path& results);

}  // namespace telestrain::viz
