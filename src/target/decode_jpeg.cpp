// jpeglib.h needs what <cstdio> declares before it.
#include <cstdio>
// clang-format off
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <csetjmp>

#include "target/image_header.h"
#include "target/pixel_decoders.h"

namespace telestrain {
namespace {

// Cameras write 10 at the most; every scan of a progressive file costs a pass over all pixels.
constexpr int kMostScans = 64;

struct Decoder {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf leave{};
  char reason[JMSG_LENGTH_MAX] = "";
};

Decoder& Of(j_common_ptr jpeg) { return *static_cast<Decoder*>(jpeg->client_data); }

// Leaves by longjmp: C++ would not pass C frames.
[[noreturn]] void Leave(j_common_ptr jpeg) {
  jpeg->err->format_message(jpeg, Of(jpeg).reason);
  std::longjmp(Of(jpeg).leave, 1);
}

// What libjpeg only warns of is damage, but for odd versions in the header.
void RefuseWarning(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  if (level < 0 && code != JWRN_JFIF_MAJOR && code != JWRN_ADOBE_XFORM) Leave(jpeg);
}

void NoOutput(j_common_ptr) {}

void CountScans(j_common_ptr jpeg) {
  auto& decoder = Of(jpeg);
  if (decoder.jpeg.input_scan_number <= kMostScans) return;
  std::snprintf(decoder.reason, sizeof decoder.reason, "more than %d scans", kMostScans);
  std::longjmp(decoder.leave, 1);
}

// What longjmp may leave behind is held by the caller; no object is made here.
bool ReadPixels(Decoder* decoder, std::string_view bytes, cv::Mat* pixels) {
  jpeg_decompress_struct* jpeg = &decoder->jpeg;
  if (setjmp(decoder->leave) != 0) return false;
  jpeg_create_decompress(jpeg);
  jpeg_mem_src(jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(jpeg, TRUE);
  // A marker without a length, before the frame, leads readers of the header elsewhere.
  const auto stated = SizeFromHeader(bytes);
  if (!stated || stated->width_px != jpeg->image_width || stated->height_px != jpeg->image_height) {
    std::snprintf(decoder->reason, sizeof decoder->reason, "a second size, %u x %u px",
                  jpeg->image_width, jpeg->image_height);
    return false;
  }
  if (jpeg->num_components != 1 && jpeg->num_components != 3) {
    std::snprintf(decoder->reason, sizeof decoder->reason, "%d colours, as of CMYK",
                  jpeg->num_components);
    return false;
  }
  jpeg->out_color_space = jpeg->num_components == 1 ? JCS_GRAYSCALE : JCS_EXT_BGR;
  jpeg->progress = &decoder->progress;
  jpeg_start_decompress(jpeg);
  pixels->create(static_cast<int>(jpeg->output_height), static_cast<int>(jpeg->output_width),
                 CV_8UC(jpeg->output_components));
  while (jpeg->output_scanline < jpeg->output_height) {
    unsigned char* row = pixels->ptr(static_cast<int>(jpeg->output_scanline));
    jpeg_read_scanlines(jpeg, &row, 1);
  }
  jpeg_finish_decompress(jpeg);
  return true;
}

}  // namespace

DecodedPixels DecodeJpeg(std::string_view bytes) {
  Decoder decoder;
  decoder.jpeg.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = Leave;
  decoder.errors.emit_message = RefuseWarning;
  decoder.errors.output_message = NoOutput;
  decoder.progress.progress_monitor = CountScans;
  decoder.jpeg.client_data = &decoder;
  DecodedPixels decoded;
  if (!ReadPixels(&decoder, bytes, &decoded.pixels)) decoded.pixels.release();
  const std::size_t left = decoder.jpeg.src == nullptr ? 0 : decoder.jpeg.src->bytes_in_buffer;
  const std::size_t at = left > bytes.size() ? bytes.size() : bytes.size() - left;
  jpeg_destroy_decompress(&decoder.jpeg);
  if (decoded.pixels.empty())
    decoded.failure = "byte " + std::to_string(at) + " of " + std::to_string(bytes.size()) + ": " +
                      decoder.reason;
  return decoded;
}

}  // namespace telestrain
