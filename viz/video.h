#pragma once

#include <filesystem>

#include "base/console.h"
#include "base/result.h"
#include "viz/render.h"

namespace telestrain {

// A film of a results folder. Its pictures are those of RenderOptions; 0 asks for the default.
struct VideoOptions {
  // A turntable turns once in 8 s, slow enough to follow; a load cycle shows every state for 1.5 s,
  // for less where they would take more than 600 s.
  double seconds = 0;
  // 20 of an MP4; 10 of a GIF, whose size grows with every frame. Up to 60, of a GIF up to 50.
  int frames_per_second = 0;
};

// Size and resolution when the user names none: 1280 x 790 px for an MP4, 800 x 494 for a GIF, both
// as wide as the report's text on paper. Fails (kUsage) for a file of another kind.
Result<RenderOptions> DefaultFrame(const std::filesystem::path& file);

// The array with its boards and the pipe, turned once about its upward axis. Writes `file`, whose
// ending says the format: .mp4 (H.264, even sides) or .gif. The same results give the same bytes on
// one machine. Fails with kUsage when an option is out of range, with kBadInput when the results
// cannot be read, with kOutputFailed when drawing, encoding or writing fails.
Status RenderTurntable(const std::filesystem::path& results, const RenderOptions& options,
                       const VideoOptions& video, const std::filesystem::path& file,
                       Console& console);

// The strain picture of every state in the order of the load steps, all with one colour range
// (options.range, else that of all states together). Fails as above, and with kUsage when no strain
// was measured.
Status RenderStates(const std::filesystem::path& results, const RenderOptions& options,
                    const VideoOptions& video, const std::filesystem::path& file, Console& console);

}  // namespace telestrain
