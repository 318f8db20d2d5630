#include "simulation/gray_png.h"

#include <png.h>
#include <zlib.h>

#include <csetjmp>
#include <cstdint>
#include <new>
#include <vector>

namespace telestrain {
namespace {

// No exception may pass libpng.
void Append(png_structp png, png_bytep bytes, png_size_t count) {
  bool has_room = true;
  try {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(bytes), count);
  } catch (const std::bad_alloc&) {
    has_room = false;
  }
  if (!has_room) png_error(png, "out of memory");
}

void KeepMessage(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void Ignore(png_structp, png_const_charp) {}

// As the format wants them: the high byte of 16 bits first.
std::vector<std::uint8_t> LevelBytes(const GrayImage& image) {
  std::vector<std::uint8_t> bytes;
  const bool two = image.max_gray > 255;
  bytes.reserve((two ? 2 : 1) * image.pixels.size());
  for (const float gray : image.pixels) {
    const auto level = static_cast<std::uint16_t>(gray);
    if (two) bytes.push_back(static_cast<std::uint8_t>(level >> 8));
    bytes.push_back(static_cast<std::uint8_t>(level & 0xFF));
  }
  return bytes;
}

// Nothing in here has a destructor: libpng leaves it with longjmp when it fails. OpenCV's choice of
// filter, level and strategy, its fastest: noise compresses no better with the others.
bool Write(png_structp png, png_infop info, const GrayImage& image, const std::uint8_t* levels) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_compression_level(png, Z_BEST_SPEED);
  png_set_compression_strategy(png, Z_RLE);
  const int bytes_each = image.max_gray > 255 ? 2 : 1;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8 * bytes_each, PNG_COLOR_TYPE_GRAY,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y)
    png_write_row(png, levels + static_cast<std::ptrdiff_t>(y) * bytes_each * image.width);
  png_write_end(png, info);
  return true;
}

}  // namespace

Result<std::string> EncodePng(const GrayImage& image) {
  std::string bytes, message = "out of memory";
  const std::vector<std::uint8_t> levels = LevelBytes(image);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, KeepMessage, Ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool written = false;
  if (info != nullptr) {
    png_set_write_fn(png, &bytes, Append, nullptr);
    written = Write(png, info, image, levels.data());
  }
  png_destroy_write_struct(&png, &info);
  if (!written) return OutputFailed("PNG encoding failed: " + message);
  return bytes;
}

}  // namespace telestrain
