#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "target/board_observation.h"

namespace telestrain {

// corners.vnl: the detected corners as a table that mrcal and a person can read. The legend is
// `# filename x y level`; a board is one block of lines named `<image>#<view>`, x of the target
// running fastest, pixel coordinates on the whole sensor, level 0; a missing corner is `- - -`, a
// rejected board one such line. Numbers are written so that they read back to the same value.
// Covariances and the reason of a rejection are not part of the format.

// The whole file. Blocks keep the order of the observations.
std::string CornersVnlText(const std::vector<BoardObservation>& boards);
Status WriteCornersVnl(const std::vector<BoardObservation>& boards,
                       const std::filesystem::path& path);

// Reads it back. Every block must have `corner_count` lines, or one for a rejected board. Corners
// get the covariance 1 px^2 times the identity. `name` stands for the file in errors, which name
// the line.
Result<std::vector<BoardObservation>> ParseCornersVnl(const std::string& name,
                                                      const std::string& text, int corner_count);
Result<std::vector<BoardObservation>> ReadCornersVnl(const std::filesystem::path& path,
                                                     int corner_count);

}  // namespace telestrain
