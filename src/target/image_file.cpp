#include "target/image_file.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "base/files.h"
#include "base/late_library.h"
#include "target/image_header.h"

namespace telestrain {
namespace {

constexpr long long kMostPixels = 100'000'000;  // four times the largest common sensors
constexpr const char* kFormatRemedy = "; give an 8- or 16-bit PNG, TIFF, BMP, PGM or JPEG";

Error Undecodable(const std::string& name) {
  return BadInput(
      name + ": the image cannot be decoded (damaged or cut short); record or copy it " + "again");
}

std::string SizeText(long long width, long long height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

Status CheckSize(const std::string& name, const ImageSize& found, const ImageSize& wanted) {
  if (wanted.width_px > 0 &&
      (found.width_px != wanted.width_px || found.height_px != wanted.height_px))
    return BadInput(name + ": the image has " + SizeText(found.width_px, found.height_px) +
                    ", wanted are " + SizeText(wanted.width_px, wanted.height_px) +
                    " as the session's sensor says");
  if (found.width_px > kMostPixels / found.height_px)
    return BadInput(name + ": the image has " + SizeText(found.width_px, found.height_px) +
                    ", more than the limit of 100 million pixels");
  return {};
}

// cv::imdecode of a library that is loaded when it is needed.
cv::Mat Imdecode(const cv::Mat& bytes) {
  static const LateLibrary library(TELESTRAIN_IMGCODECS);
  static auto* const imdecode =
      library.Find<cv::Mat(const cv::_InputArray&, int)>("_ZN2cv8imdecodeERKNS_11_InputArrayEi");
  return imdecode ? imdecode(bytes, cv::IMREAD_UNCHANGED) : cv::Mat();
}

// Empty when the bytes are no image.
cv::Mat Decode(const std::string& bytes) {
  try {
    const cv::Mat input(1, static_cast<int>(bytes.size()), CV_8U,
                        const_cast<char*>(bytes.data()));  // only read
    return Imdecode(input);
  } catch (const cv::Exception&) {
    return {};
  }
}

// One channel of floats in the file's own grey levels.
std::optional<GrayImage> ToGray(const cv::Mat& decoded) {
  if (decoded.depth() != CV_8U && decoded.depth() != CV_16U) return std::nullopt;
  cv::Mat gray;
  decoded.convertTo(gray, CV_32F);
  if (gray.channels() == 3)
    cv::cvtColor(gray, gray, cv::COLOR_BGR2GRAY);
  else if (gray.channels() == 4)
    cv::cvtColor(gray, gray, cv::COLOR_BGRA2GRAY);
  else if (gray.channels() != 1)
    return std::nullopt;
  GrayImage image;
  image.width = gray.cols;
  image.height = gray.rows;
  image.max_gray = decoded.depth() == CV_8U ? 255.0F : 65535.0F;
  image.pixels.reserve(gray.total());
  for (int y = 0; y < gray.rows; ++y)
    image.pixels.insert(image.pixels.end(), gray.ptr<float>(y), gray.ptr<float>(y) + gray.cols);
  return image;
}

}  // namespace

Status CheckImageBytes(const std::string& name, std::string_view bytes, int width_px,
                       int height_px) {
  if (bytes.empty()) return BadInput(name + ": the file is empty" + kFormatRemedy);
  const auto stated = SizeFromHeader(bytes);
  if (!stated) return BadInput(name + ": the file does not begin like an image" + kFormatRemedy);
  TELESTRAIN_RETURN_IF_ERROR(CheckSize(name, *stated, {width_px, height_px}));
  if (IsCutShort(bytes)) return Undecodable(name);
  return {};
}

Result<GrayImage> ReadGrayImage(const std::filesystem::path& path, int width_px, int height_px) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  return DecodeGrayImage(path.string(), bytes, width_px, height_px);
}

Result<GrayImage> DecodeGrayImage(const std::string& name, const std::string& bytes, int width_px,
                                  int height_px) {
  TELESTRAIN_RETURN_IF_ERROR(CheckImageBytes(name, bytes, width_px, height_px));
  const cv::Mat decoded = Decode(bytes);
  if (decoded.empty()) return Undecodable(name);
  TELESTRAIN_RETURN_IF_ERROR(CheckSize(name, {decoded.cols, decoded.rows}, {width_px, height_px}));
  auto image = ToGray(decoded);
  if (!image)
    return BadInput(name + ": the pixels are neither 8- nor 16-bit grey or colour" + kFormatRemedy);
  return std::move(*image);
}

void KeepImagesOnOneThread() { cv::setNumThreads(1); }

}  // namespace telestrain
