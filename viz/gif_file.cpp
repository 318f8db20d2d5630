#include <gif_lib.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "base/files.h"
#include "viz/palette.h"
#include "viz/video_file.h"

namespace telestrain::viz {
namespace {

namespace fs = std::filesystem;

// The last entry of every palette means: as before.
constexpr std::uint8_t kUnchanged = 255;
constexpr std::size_t kMostColors = 255;

int Append(GifFileType* gif, const GifByteType* bytes, int count) {
  static_cast<std::string*>(gif->UserData)
      ->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
  return count;
}

// The part of a frame that differs from the last one.
struct Change {
  int left = 0, top = 0, right = 0, bottom = 0;  // right and bottom: one beyond
};

bool SamePixel(const RgbImage& a, const RgbImage& b, std::size_t pixel) {
  return std::memcmp(&a.rgb[3 * pixel], &b.rgb[3 * pixel], 3) == 0;
}

Change ChangeBetween(const RgbImage& last, const RgbImage& next) {
  Change change{next.width_px, next.height_px, 0, 0};
  for (int y = 0; y < next.height_px; ++y)
    for (int x = 0; x < next.width_px; ++x) {
      if (SamePixel(last, next, static_cast<std::size_t>(y * next.width_px + x))) continue;
      change = {std::min(change.left, x), std::min(change.top, y), std::max(change.right, x + 1),
                std::max(change.bottom, y + 1)};
    }
  return change;
}

class GifFile : public VideoFile {
 public:
  GifFile(fs::path path, int width_px, int height_px, int fps)
      : path_(std::move(path)), fps_(fps), width_px_(width_px), height_px_(height_px) {}
  ~GifFile() override {
    if (gif_ != nullptr) EGifCloseFile(gif_, nullptr);
  }

  Status Open() {
    int code = 0;
    gif_ = EGifOpen(&bytes_, Append, &code);
    if (gif_ == nullptr) return Failed(code);
    EGifSetGifVersion(gif_, true);
    if (EGifPutScreenDesc(gif_, width_px_, height_px_, 8, 0, nullptr) == GIF_ERROR)
      return Failed(gif_->Error);
    // Endless repetition: the application extension that all viewers know.
    const unsigned char forever[3] = {1, 0, 0};
    const bool is_written = EGifPutExtensionLeader(gif_, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
                            EGifPutExtensionBlock(gif_, 11, "NETSCAPE2.0") == GIF_OK &&
                            EGifPutExtensionBlock(gif_, sizeof forever, forever) == GIF_OK &&
                            EGifPutExtensionTrailer(gif_) == GIF_OK;
    return is_written ? Status() : Failed(gif_->Error);
  }

  // Written when the next one comes: only then it is known how long it stays.
  Status Add(const RgbImage& frame) override {
    if (waiting_ && waiting_->rgb == frame.rgb) {
      ++repeats_;
      return {};
    }
    TELESTRAIN_RETURN_IF_ERROR(WriteWaiting());
    waiting_ = frame;
    repeats_ = 1;
    return {};
  }

  Status Close() override {
    TELESTRAIN_RETURN_IF_ERROR(WriteWaiting());
    int code = 0;
    const int closed = EGifCloseFile(gif_, &code);
    gif_ = nullptr;
    if (closed == GIF_ERROR) return Failed(code);
    return WriteFileAtomically(path_, bytes_);
  }

 private:
  Error Failed(int code) const {
    const char* text = GifErrorString(code);
    return OutputFailed(path_.string() + ": the GIF cannot be written: " +
                        (text != nullptr ? text : "unknown error"));
  }

  Status WriteWaiting() {
    if (!waiting_) return {};
    Change change{0, 0, width_px_, height_px_};
    if (shown_) change = ChangeBetween(*shown_, *waiting_);
    const IndexedImage indexed = IndexedPart(change);
    // Hundredths of a second from the start, so that roundings do not add up.
    const int begin = Hundredths(frames_), end = Hundredths(frames_ + repeats_);
    frames_ += repeats_;
    TELESTRAIN_RETURN_IF_ERROR(Write(indexed, change, end - begin));
    shown_ = std::move(waiting_);
    waiting_.reset();
    return {};
  }

  int Hundredths(int frames) const { return (100 * frames + fps_ / 2) / fps_; }

  // The waiting frame inside `change`, unchanged pixels marked.
  IndexedImage IndexedPart(const Change& change) const {
    RgbImage part{change.right - change.left, change.bottom - change.top, 0, {}};
    std::vector<bool> same;
    for (int y = change.top; y < change.bottom; ++y)
      for (int x = change.left; x < change.right; ++x) {
        const auto pixel = static_cast<std::size_t>(y * width_px_ + x);
        same.push_back(shown_ && SamePixel(*shown_, *waiting_, pixel));
        const std::uint8_t* rgb = &waiting_->rgb[3 * pixel];
        // What stays takes no colour of the palette: white has one anyway.
        for (std::size_t c = 0; c < 3; ++c) part.rgb.push_back(same.back() ? 255 : rgb[c]);
      }
    IndexedImage indexed = Indexed(part, kMostColors);
    for (std::size_t i = 0; i < same.size(); ++i)
      if (same[i]) indexed.indices[i] = kUnchanged;
    return indexed;
  }

  Status Write(const IndexedImage& indexed, const Change& change, int delay) {
    std::array<GifColorType, 256> colors{};
    for (std::size_t i = 0; i < indexed.colors.size(); ++i)
      colors[i] = {indexed.colors[i][0], indexed.colors[i][1], indexed.colors[i][2]};
    ColorMapObject* map = GifMakeMapObject(static_cast<int>(colors.size()), colors.data());
    if (map == nullptr) return Failed(E_GIF_ERR_NOT_ENOUGH_MEM);
    GraphicsControlBlock control{DISPOSE_DO_NOT, false, delay, kUnchanged};
    GifByteType extension[4];
    const auto size = static_cast<int>(EGifGCBToExtension(&control, extension));
    const int width = change.right - change.left, height = change.bottom - change.top;
    bool is_written =
        EGifPutExtension(gif_, GRAPHICS_EXT_FUNC_CODE, size, extension) == GIF_OK &&
        EGifPutImageDesc(gif_, change.left, change.top, width, height, false, map) == GIF_OK;
    std::vector<GifPixelType> line(static_cast<std::size_t>(width));
    for (int y = 0; is_written && y < height; ++y) {
      std::copy_n(indexed.indices.begin() + y * width, width, line.begin());
      is_written = EGifPutLine(gif_, line.data(), width) == GIF_OK;
    }
    GifFreeMapObject(map);
    return is_written ? Status() : Failed(gif_->Error);
  }

  fs::path path_;
  int fps_, width_px_, height_px_;
  std::string bytes_;
  GifFileType* gif_ = nullptr;
  std::optional<RgbImage> shown_, waiting_;
  int repeats_ = 0, frames_ = 0;
};

}  // namespace

Result<std::unique_ptr<VideoFile>> OpenGif(const fs::path& path, int width_px, int height_px,
                                           int fps) {
  auto file = std::make_unique<GifFile>(path, width_px, height_px, fps);
  TELESTRAIN_RETURN_IF_ERROR(file->Open());
  return std::unique_ptr<VideoFile>(std::move(file));
}

}  // namespace telestrain::viz
