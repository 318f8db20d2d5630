#pragma once

#include <filesystem>
#include <memory>

#include "base/result.h"
#include "viz/pictures.h"

namespace telestrain::viz {

// A film that is being written. The file appears under its name when Close() succeeded. The same
// frames give the same bytes on one machine.
class VideoFile {
 public:
  virtual ~VideoFile() = default;
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  // Frames are opaque and of one size. Fails (kOutputFailed) when encoding does.
  virtual Status Add(const RgbImage& frame) = 0;
  virtual Status Close() = 0;

 protected:
  VideoFile() = default;
};

enum class VideoFormat { kMp4, kGif };

// By the ending .mp4 or .gif; another one fails (kUsage).
Result<VideoFormat> VideoFormatOf(const std::filesystem::path& path);

// H.264 with 4:2:0 colours, as every browser plays it; both sides of the picture must be even.
// Fails (kOutputFailed) when OpenCV's FFmpeg has no encoder for it.
Result<std::unique_ptr<VideoFile>> OpenMp4(const std::filesystem::path& path, int width_px,
                                           int height_px, int fps);

// Endless repetition; every frame has a palette of its own of up to 255 colours and holds only what
// changed since the last one. `fps` up to 50: the format counts hundredths of a second.
Result<std::unique_ptr<VideoFile>> OpenGif(const std::filesystem::path& path, int width_px,
                                           int height_px, int fps);

}  // namespace telestrain::viz
