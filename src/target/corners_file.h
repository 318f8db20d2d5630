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

// Reads it back, also as mrcal's tools and other detectors write it: with the legend
// `# filename x y` no level follows, with `# filename x y level` it is the number of times the
// image was halved before the corner was found. mrcal weights such a corner by 2^-level, so its
// covariance is 4^level px^2 times the identity. A corner is missing where a field is `-`, the
// level is negative or x or y is. Every block must have `corner_count` lines, or one for a
// rejected board. `name` stands for the file in errors, which name the line.
Result<std::vector<BoardObservation>> ParseCornersVnl(const std::string& name,
                                                      const std::string& text, int corner_count);
Result<std::vector<BoardObservation>> ReadCornersVnl(const std::filesystem::path& path,
                                                     int corner_count);

}  // namespace telestrain
