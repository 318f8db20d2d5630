#pragma once

#include <filesystem>

#include "base/result.h"

namespace telestrain {

// The files of a results folder, in the order in which the steps make them.
enum class Step { kDetect, kCalibrate, kDiagnose, kVerify, kMeasure, kRender, kReport, kReview };

// Fails (kBadInput) when the folder is no results folder (no inputs.json), or when a result of a
// step earlier than `before` was made from another version of a file than the one that lies there.
Status RequireConsistent(const std::filesystem::path& results, Step before);

}  // namespace telestrain
