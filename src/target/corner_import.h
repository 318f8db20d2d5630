#pragma once

#include <filesystem>

#include "target/detection.h"

namespace telestrain {

// Takes the boards from a corner table (corners_file.h) instead of the calibration images:
// kForeignSigma_px for level 0, twice that for every further level. Images and views of the session
// that the table has no block for become rejected boards. Crosses are found in the ruler images.
// Fails (kBadInput) when a block names an image or view that the session has not, comes twice, has
// corners outside its view, or when the blocks run in another order than x of the target fastest
// from the corner with the smallest x and y.
Result<Detection> ImportCorners(const Session& session, const std::filesystem::path& corners_vnl,
                                Console& console);

}  // namespace telestrain
