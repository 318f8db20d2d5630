#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "session/session.h"

namespace telestrain {

// Arguments that are lists in one word. All fail with kUsage.

// The comma-separated whole numbers, or nothing.
std::optional<std::vector<int>> WholeNumbersIn(const std::string& text);

// The numbers of `--region text` as a region of an image of this size.
Result<PixelRegion> RegionInside(const std::string& text, const std::vector<int>& numbers,
                                 int width_px, int height_px);

// `--cull X,Y,WIDTH,HEIGHT` in pixels of the sensor; its far corner fits an int.
Result<PixelRegion> CulledRegion(const std::string& text);

// `--document KEY=TEXT` as key and text.
Result<std::pair<std::string, std::string>> DocumentEntry(const std::string& text);

}  // namespace telestrain
