#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "target/pixel_decoders.h"

namespace telestrain {
namespace {

// Texts and profiles of a file are not looked at; one may unpack to eight megabytes.
constexpr png_uint_32 kMostKeptChunks = 2;

struct Source {
  std::string_view bytes;
  std::size_t at = 0;
  char reason[200] = "";
};

void ReadBytes(png_structp png, png_bytep into, std::size_t count) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (count > source.bytes.size() - source.at) png_error(png, "the file ends");
  std::memcpy(into, source.bytes.data() + source.at, count);
  source.at += count;
}

// In place of libpng's own, which writes to stderr. Leaves by longjmp: C++ would not pass C frames.
[[noreturn]] void KeepReason(png_structp png, png_const_charp reason) {
  auto& source = *static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source.reason, reason, sizeof source.reason - 1);
  png_longjmp(png, 1);
}

void NoWarning(png_structp, png_const_charp) {}

// What longjmp may leave behind is held by the caller; no object is made here.
bool ReadPixels(png_structp png, png_infop info, cv::Mat* pixels, std::vector<png_bytep>* rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_chunk_cache_max(png, kMostKeptChunks);
  png_read_info(png, info);
  png_set_palette_to_rgb(png);
  png_set_expand_gray_1_2_4_to_8(png);
  png_set_strip_alpha(png);
  png_set_bgr(png);
  if (std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const int depth = png_get_bit_depth(png, info) == 16 ? CV_16U : CV_8U;
  pixels->create(static_cast<int>(png_get_image_height(png, info)),
                 static_cast<int>(png_get_image_width(png, info)),
                 CV_MAKETYPE(depth, png_get_channels(png, info)));
  if (png_get_rowbytes(png, info) != pixels->cols * pixels->elemSize())
    png_error(png, "rows of another length");
  rows->resize(static_cast<std::size_t>(pixels->rows));
  for (int y = 0; y < pixels->rows; ++y) (*rows)[static_cast<std::size_t>(y)] = pixels->ptr(y);
  png_read_image(png, rows->data());
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

DecodedPixels DecodePng(std::string_view bytes) {
  Source source{bytes};
  DecodedPixels decoded;
  std::vector<png_bytep> rows;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, KeepReason, NoWarning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info != nullptr) {
    png_set_read_fn(png, &source, ReadBytes);
    if (!ReadPixels(png, info, &decoded.pixels, &rows)) decoded.pixels.release();
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (decoded.pixels.empty())
    decoded.failure = "byte " + std::to_string(source.at) + " of " + std::to_string(bytes.size()) +
                      ": " + source.reason;
  return decoded;
}

}  // namespace telestrain
