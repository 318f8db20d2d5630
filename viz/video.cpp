#include "viz/video.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>

#include "base/numbers.h"
#include "base/parallel.h"
#include "viz/picture_set.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_from_results.h"
#include "viz/video_file.h"
#include "viz/window_keeper.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;
using viz::VideoFormat;

constexpr double kTurn_s = 8, kState_s = 1.5, kMost_s = 600;
constexpr int kMp4Rate = 20, kGifRate = 10, kMostMp4Rate = 60, kMostGifRate = 50;

Error Usage(std::string message) { return {ErrorKind::kUsage, std::move(message)}; }

// The options with defaults filled in.
struct Timing {
  double seconds = 0;
  int rate = 0;
};

Result<Timing> TimingOf(const VideoOptions& video, VideoFormat format, double default_s) {
  const bool is_gif = format == VideoFormat::kGif;
  Timing timing{video.seconds == 0 ? default_s : video.seconds, video.frames_per_second};
  if (timing.rate == 0) timing.rate = is_gif ? kGifRate : kMp4Rate;
  const int most = is_gif ? kMostGifRate : kMostMp4Rate;
  if (timing.rate < 1 || timing.rate > most)
    return Usage("video: from 1 to " + std::to_string(most) + " frames per second are wanted" +
                 (is_gif ? " for a GIF" : "") + ", found " + std::to_string(timing.rate));
  if (!(timing.seconds >= 1.0 / timing.rate) || timing.seconds > kMost_s)
    return Usage("video: from one frame to " + FormatShortest(kMost_s) +
                 " seconds are wanted, found " + FormatShortest(timing.seconds));
  return timing;
}

// A picture and for how many frames it stays.
struct Shot {
  std::function<Result<viz::Picture>()> draw;
  int frames = 1;
};

Result<std::unique_ptr<viz::VideoFile>> OpenVideo(const fs::path& file, VideoFormat format,
                                                  const RenderOptions& options, int rate) {
  return format == VideoFormat::kGif
             ? viz::OpenGif(file, options.width_px, options.height_px, rate)
             : viz::OpenMp4(file, options.width_px, options.height_px, rate);
}

Status AddFrames(viz::VideoFile& film, const viz::RgbImage& image, int frames) {
  for (int i = 0; i < frames; ++i) TELESTRAIN_RETURN_IF_ERROR(film.Add(image));
  return {};
}

// Every picture is encoded while the next one is drawn.
Status Shoot(const std::vector<Shot>& shots, viz::VideoFile& film) {
  const viz::WindowKeeper keeper;
  std::optional<viz::RgbImage> last;
  for (std::size_t i = 0; i <= shots.size(); ++i) {
    Status drawn;
    std::optional<viz::RgbImage> next;
    // All drawing stays on this thread: the OpenGL context is current on it.
    auto encoded = std::async(BesideOwnWork(), [&] {
      return last ? AddFrames(film, *last, shots[i - 1].frames) : Status();
    });
    if (i < shots.size()) {
      auto picture = shots[i].draw();
      if (picture)
        next = std::move(picture->image);
      else
        drawn = picture.error();
    }
    TELESTRAIN_RETURN_IF_ERROR(encoded.get());
    TELESTRAIN_RETURN_IF_ERROR(drawn);
    last = std::move(next);
  }
  return film.Close();
}

Status CheckVideo(const RenderOptions& options) {
  TELESTRAIN_RETURN_IF_ERROR(CheckRenderOptions(options));
  if (options.transparent) return Usage("video: a film has no transparent paper");
  if (!options.view.empty()) return Usage("video: a film is no picture of the standard set");
  if (options.state != "largest")
    return Usage("video: a film shows no single state, found '" + options.state +
                 "'; --view pipe_strain takes it");
  return {};
}

}  // namespace

namespace viz {

Result<VideoFormat> VideoFormatOf(const fs::path& path) {
  if (path.extension() == ".mp4") return VideoFormat::kMp4;
  if (path.extension() == ".gif") return VideoFormat::kGif;
  return Usage(path.string() + ": a film ends in .mp4 or .gif");
}

}  // namespace viz

Result<RenderOptions> DefaultFrame(const fs::path& file) {
  TELESTRAIN_ASSIGN_OR_RETURN(const VideoFormat format, viz::VideoFormatOf(file));
  RenderOptions options;
  options.width_px = format == VideoFormat::kGif ? 800 : 1280;
  options.height_px = format == VideoFormat::kGif ? 494 : 790;
  return options;
}

Status RenderTurntable(const fs::path& results, const RenderOptions& options,
                       const VideoOptions& video, const fs::path& file, Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(CheckVideo(options));
  if (!options.quantity.empty() || options.range)
    return Usage("video: a turntable takes no quantity or range; a film of the states does");
  TELESTRAIN_ASSIGN_OR_RETURN(const VideoFormat format, viz::VideoFormatOf(file));
  TELESTRAIN_ASSIGN_OR_RETURN(const Timing timing, TimingOf(video, format, kTurn_s));
  TELESTRAIN_ASSIGN_OR_RETURN(const viz::Scene scene, viz::SceneFromResults(results));
  const auto frames = static_cast<int>(std::lround(timing.seconds * timing.rate));
  std::vector<Shot> shots;
  for (int i = 0; i < frames; ++i)
    shots.push_back({[&scene, &options, azimuth_deg = 360.0 * i / frames] {
      return viz::DrawTurntable(scene, options, azimuth_deg);
    }});
  TELESTRAIN_ASSIGN_OR_RETURN(const auto film, OpenVideo(file, format, options, timing.rate));
  TELESTRAIN_RETURN_IF_ERROR(Shoot(shots, *film));
  console.Say("wrote " + file.string());
  return {};
}

Status RenderStates(const fs::path& results, const RenderOptions& options,
                    const VideoOptions& video, const fs::path& file, Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(CheckVideo(options));
  TELESTRAIN_ASSIGN_OR_RETURN(const VideoFormat format, viz::VideoFormatOf(file));
  TELESTRAIN_ASSIGN_OR_RETURN(const viz::Scene scene, viz::SceneFromResults(results));
  if (!scene.pipe || scene.pipe->states.empty())
    return Usage("video: no strain was measured; run 'telestrain measure' first");
  TELESTRAIN_ASSIGN_OR_RETURN(viz::PictureChoices choices, viz::ChoicesFor(scene, options));
  const auto count = static_cast<int>(scene.pipe->states.size());
  TELESTRAIN_ASSIGN_OR_RETURN(const Timing timing,
                              TimingOf(video, format, std::min(kState_s * count, kMost_s)));
  const viz::ColorScale scale = viz::ValueScale(*scene.pipe, choices.quantity);
  if (!choices.range) choices.range = {scale.low, scale.high};
  const auto frames = static_cast<int>(std::lround(timing.seconds * timing.rate));
  std::vector<Shot> shots;
  for (int i = 0; i < count; ++i) {
    choices.state = static_cast<std::size_t>(i);
    shots.push_back(
        {[&scene, &options, choices] { return viz::DrawPipeStrain(scene, options, choices); },
         std::max(1, frames * (i + 1) / count - frames * i / count)});
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const auto film, OpenVideo(file, format, options, timing.rate));
  TELESTRAIN_RETURN_IF_ERROR(Shoot(shots, *film));
  console.Say("wrote " + file.string());
  return {};
}

}  // namespace telestrain
