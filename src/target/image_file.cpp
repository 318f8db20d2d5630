#include "target/image_file.h"

#include <opencv2/imgproc.hpp>

#include "base/files.h"
#include "target/image_header.h"
#include "target/image_structure.h"
#include "target/pixel_decoders.h"

namespace telestrain {
namespace {

constexpr long long kMostPixels = 100'000'000;  // four times the largest common sensors
constexpr const char* kFormatRemedy = "; give an 8- or 16-bit PNG, TIFF, BMP, PGM or JPEG";

Error Unfit(const std::string& name, const std::string& fault) {
  return BadInput(name + ": the image " + fault + "; record or copy it again, as a single 8- or " +
                  "16-bit PNG, TIFF, BMP, PGM or JPEG");
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
                    ", more than the limit of 100 million pixels; cut it to the part that matters");
  return {};
}

DecodedPixels Decode(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return DecodePng(bytes);
  if (bytes.starts_with("\xFF\xD8")) return DecodeJpeg(bytes);
  return DecodeOther(bytes);
}

// One channel of floats in the file's own grey levels. Row by row: a copy of the whole image as
// floats would take more memory than all else.
GrayImage ToGray(const cv::Mat& decoded) {
  GrayImage image;
  image.width = decoded.cols;
  image.height = decoded.rows;
  image.max_gray = decoded.depth() == CV_8U ? 255.0F : 65535.0F;
  image.pixels.reserve(decoded.total());
  cv::Mat row;
  for (int y = 0; y < decoded.rows; ++y) {
    decoded.row(y).convertTo(row, CV_32F);
    if (row.channels() == 3) cv::cvtColor(row, row, cv::COLOR_BGR2GRAY);
    image.pixels.insert(image.pixels.end(), row.ptr<float>(), row.ptr<float>() + row.cols);
  }
  return image;
}

}  // namespace

Status CheckImageBytes(const std::string& name, std::string_view bytes, int width_px,
                       int height_px) {
  if (bytes.empty()) return BadInput(name + ": the file is empty" + kFormatRemedy);
  const auto stated = SizeFromHeader(bytes);
  if (!stated) return BadInput(name + ": the file does not begin like an image" + kFormatRemedy);
  TELESTRAIN_RETURN_IF_ERROR(CheckSize(name, *stated, {width_px, height_px}));
  const std::string fault = StructureFault(bytes);
  return fault.empty() ? Status() : Status(Unfit(name, fault));
}

Result<GrayImage> ReadGrayImage(const std::filesystem::path& path, int width_px, int height_px) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMostImageBytes));
  return DecodeGrayImage(path.string(), bytes, width_px, height_px);
}

Result<GrayImage> DecodeGrayImage(const std::string& name, const std::string& bytes, int width_px,
                                  int height_px) {
  TELESTRAIN_RETURN_IF_ERROR(CheckImageBytes(name, bytes, width_px, height_px));
  const DecodedPixels decoded = Decode(bytes);
  if (!decoded.failure.empty()) return Unfit(name, "is damaged, " + decoded.failure);
  const cv::Mat& pixels = decoded.pixels;
  TELESTRAIN_RETURN_IF_ERROR(CheckSize(name, {pixels.cols, pixels.rows}, {width_px, height_px}));
  const bool is_known = (pixels.depth() == CV_8U || pixels.depth() == CV_16U) &&
                        (pixels.channels() == 1 || pixels.channels() == 3);
  if (!is_known)
    return BadInput(name + ": the pixels are neither 8- nor 16-bit grey or colour" + kFormatRemedy);
  return ToGray(pixels);
}

void KeepImagesOnOneThread() { cv::setNumThreads(1); }

}  // namespace telestrain
