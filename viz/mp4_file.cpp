#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "base/check.h"
#include "base/descriptor.h"
#include "base/files.h"
#include "base/late_library.h"
#include "base/signals.h"
#include "viz/video_file.h"

namespace telestrain::viz {
namespace {

namespace fs = std::filesystem;

// cv::VideoWriter of a library that is loaded when a film is written. Its functions are called by
// their names in the library, so that the program does not need them at its start.
class LateWriter {
 public:
  LateWriter() : library_(TELESTRAIN_VIDEOIO) {
    construct_ = library_.Find<Construct>(
        "_ZN2cv11VideoWriterC1ERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEEiidNS_5Size_"
        "IiEEb");
    destroy_ = library_.Find<Destroy>("_ZN2cv11VideoWriterD1Ev");
    is_opened_ = library_.Find<IsOpened>("_ZNK2cv11VideoWriter8isOpenedEv");
    write_ = library_.Find<Write>("_ZN2cv11VideoWriter5writeERKNS_11_InputArrayE");
  }
  ~LateWriter() { Release(); }
  LateWriter(const LateWriter&) = delete;
  LateWriter& operator=(const LateWriter&) = delete;

  std::string Failure() const { return library_.Failure(); }
  bool Open(const std::string& file, int codec, double fps, const cv::Size& size) {
    if (!construct_ || !destroy_ || !is_opened_ || !write_) return false;
    construct_(place_, file, cv::CAP_FFMPEG, codec, fps, size, true);
    is_there_ = true;
    return is_opened_(place_);
  }
  void Add(const cv::Mat& frame) { write_(place_, frame); }
  void Release() {
    if (is_there_) destroy_(place_);
    is_there_ = false;
  }

 private:
  using Construct = void(void*, const std::string&, int, int, double, cv::Size, bool);
  using Destroy = void(void*);
  using IsOpened = bool(const void*);
  using Write = void(void*, const cv::_InputArray&);

  const LateLibrary library_;
  Construct* construct_;
  Destroy* destroy_;
  IsOpened* is_opened_;
  Write* write_;
  alignas(cv::VideoWriter) std::byte place_[sizeof(cv::VideoWriter)];
  bool is_there_ = false;
};

// The encoder tells nothing of a write that failed; then the boxes of the file do not fill it, or
// the index is not among them. ISO/IEC 14496-12, 4.2: a box is its size in 32 bits, big-endian, or
// 1 and the size in 64 bits after the type, and its type.
bool IsWholeFilm(const std::string& bytes) {
  const auto number = [&](std::size_t at, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  bool has_index = false;
  std::size_t at = 0;
  while (bytes.size() - at >= 8) {
    const bool is_long = number(at, 4) == 1 && bytes.size() - at >= 16;
    const std::uint64_t size = is_long ? number(at + 8, 8) : number(at, 4);
    has_index = has_index || bytes.compare(at + 4, 4, "moov") == 0;
    if (size < 8 || size > bytes.size() - at) return false;
    at += size;
  }
  return has_index && at == bytes.size();
}

class Mp4File : public VideoFile {
 public:
  explicit Mp4File(fs::path path) : path_(std::move(path)) {}
  ~Mp4File() override {
    writer_.Release();
    std::error_code code;
    if (!part_.empty()) fs::remove(part_, code);
  }

  Status Open(int width_px, int height_px, int fps) {
    TELESTRAIN_RETURN_IF_ERROR(MakePart());
    size_ = {width_px, height_px};
    if (!writer_.Failure().empty())
      return OutputFailed(path_.string() + ": cannot be encoded: " + writer_.Failure() +
                          "; a .gif needs none");
    constexpr int kH264 = 'a' | 'v' << 8 | 'c' << 16 | '1' << 24;
    // OpenCV tells of a missing encoder on stderr only; the caller gets it as an error.
    const auto level = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    const bool is_open = writer_.Open(part_.string(), kH264, fps, size_);
    cv::utils::logging::setLogLevel(level);
    if (is_open) return {};
    return OutputFailed(path_.string() +
                        ": cannot be encoded: OpenCV's FFmpeg has no H.264 encoder "
                        "(Debian packages libopencv-videoio406, libx264); a .gif needs none");
  }

  Status Add(const RgbImage& frame) override {
    TELESTRAIN_CHECK(frame.width_px == size_.width && frame.height_px == size_.height,
                     "the frames of a film have one size");
    cv::Mat bgr(size_, CV_8UC3);
    for (std::size_t i = 0; i < frame.rgb.size(); i += 3)
      for (std::size_t c = 0; c < 3; ++c) bgr.data[i + c] = frame.rgb[i + 2 - c];
    writer_.Add(bgr);
    return {};
  }

  Status Close() override {
    writer_.Release();
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(part_, kMostResultBytes));
    if (!IsWholeFilm(bytes))
      return OutputFailed(path_.string() +
                          ": the film could not be written whole; free some space or choose a "
                          "folder on another disk");
    return WriteFileAtomically(path_, bytes);
  }

 private:
  // A file of this film alone, whatever else writes to the same name. Its path is absolute:
  // FFmpeg takes what stands before a colon for a protocol.
  Status MakePart() {
    static std::atomic<int> films = 0;
    const NoSignalNow whole;  // what is done at a signal reads part_
    std::error_code code;
    part_ = TemporaryFor(fs::absolute(path_, code), "." + std::to_string(films++) + ".mp4");
    const Descriptor file{
        ::open(part_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_EXCL | O_NOFOLLOW, 0644)};
    return file.value >= 0 ? Status() : CannotWrite(path_, errno);
  }

  fs::path path_, part_;
  cv::Size size_;
  LateWriter writer_;
  const AtSignal remove_part_{[this](int) {
    if (!part_.empty()) ::unlink(part_.c_str());
    return AfterSignal::kEnd;
  }};
};

}  // namespace

Result<std::unique_ptr<VideoFile>> OpenMp4(const fs::path& path, int width_px, int height_px,
                                           int fps) {
  if (width_px % 2 != 0 || height_px % 2 != 0)
    return Error{ErrorKind::kUsage, path.string() + ": an MP4 needs even sides, found " +
                                        std::to_string(width_px) + " x " +
                                        std::to_string(height_px) + " px"};
  auto file = std::make_unique<Mp4File>(path);
  TELESTRAIN_RETURN_IF_ERROR(file->Open(width_px, height_px, fps));
  return std::unique_ptr<VideoFile>(std::move(file));
}

}  // namespace telestrain::viz
