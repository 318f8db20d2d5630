#include <iostream>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <streambuf>

#include "base/late_library.h"
#include "target/pixel_decoders.h"

namespace telestrain {
namespace {

class SilentBuffer : public std::streambuf {
  int overflow(int c) override { return c; }
};

// OpenCV writes to std::cerr what is told here in the message of the caller. Our own words go
// another way (Console keeps the stream's buffer).
class QuietErrors {
 public:
  QuietErrors() : lock_(Mutex()), before_(std::cerr.rdbuf(&nothing_)) {}
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
  ~QuietErrors() { std::cerr.rdbuf(before_); }

 private:
  static std::mutex& Mutex() {
    static std::mutex mutex;
    return mutex;
  }
  const std::lock_guard<std::mutex> lock_;
  SilentBuffer nothing_;
  std::streambuf* const before_;
};

// cv::imdecode of a library that is loaded when it is needed, by its name there.
const LateLibrary& Codecs() {
  static const LateLibrary library(TELESTRAIN_IMGCODECS);
  return library;
}

using Imdecode = cv::Mat(const cv::_InputArray&, int);
constexpr const char* kImdecode = "_ZN2cv8imdecodeERKNS_11_InputArrayEi";

}  // namespace

DecodedPixels DecodeOther(std::string_view bytes) {
  DecodedPixels decoded;
  static Imdecode* const imdecode = Codecs().Find<Imdecode>(kImdecode);
  if (!imdecode) {
    decoded.failure = "or cannot be decoded here: " + Codecs().Failure();
    return decoded;
  }
  try {
    const QuietErrors quiet;
    const cv::Mat input(1, static_cast<int>(bytes.size()), CV_8U,
                        const_cast<char*>(bytes.data()));  // only read
    decoded.pixels = imdecode(input, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    decoded.pixels.release();
  }
  if (decoded.pixels.channels() == 4) {
    cv::Mat opaque(decoded.pixels.size(), CV_MAKETYPE(decoded.pixels.depth(), 3));
    cv::mixChannels({decoded.pixels}, {opaque}, {0, 0, 1, 1, 2, 2});
    decoded.pixels = opaque;
  }
  if (decoded.pixels.empty()) decoded.failure = "its pixels do not decode";
  return decoded;
}

}  // namespace telestrain
